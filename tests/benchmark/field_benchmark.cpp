// SPDX-License-Identifier: MIT
// field/<solver>/<scene>: one field of a partly explored building, from the cells to the certified potential, with
// one thread. The peers get their matrix ready-made; only the solution is timed.
//
// field/multigrid2/<scene>: two threads.
//
// field/directions/<scene>: the effect of the uniform source on directions.
//
// The scenes house-<views>, from a run in a simulated house, need the environment variable VANTAGE_DATA.
#include <benchmark/benchmark.h>

#include <Eigen/SparseCore>
#include <benchmark/laplace_matrix.hpp>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unsupported/Eigen/IterativeSolvers>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/field/streamline.hpp>

#include "random_rooms.hpp"

#ifdef VANTAGE_HAS_SIM
#include <benchmark/house_scene.hpp>
#endif
#ifdef VANTAGE_HAS_HYPRE
#include <benchmark/boomeramg.hpp>
#endif

namespace vantage {
namespace {

RoomsOptions options_of(const std::string& scene) {
  if (scene == "51-early") {
    return {.extent = {51, 51, 51}, .room_cells = 25, .door_cells = 7, .doors = 1.0, .unexplored = 0.7, .seed = 1};
  }
  if (scene == "51-middle") {
    return {.extent = {51, 51, 51}, .room_cells = 25, .door_cells = 7, .doors = 1.0, .unexplored = 0.4, .seed = 1};
  }
  if (scene == "51") {
    return {.extent = {51, 51, 51}, .room_cells = 25, .door_cells = 7, .doors = 1.0, .unexplored = 0.15, .seed = 1};
  }
  if (scene == "128") {
    return {.extent = {128, 128, 128}, .room_cells = 26, .door_cells = 7, .doors = 0.8, .unexplored = 0.3, .seed = 2};
  }
  if (scene == "256") {
    return {.extent = {256, 256, 256}, .room_cells = 33, .door_cells = 9, .doors = 0.8, .unexplored = 0.4, .seed = 3};
  }
  if (scene == "floor") {
    return {.extent = {400, 400, 60}, .room_cells = 60, .door_cells = 12, .doors = 1.0, .unexplored = 0.1, .seed = 4};
  }
  return {.extent = {128, 128, 128},
          .room_cells = 8,
          .door_cells = 4,
          .doors = 0.45,
          .unexplored = 0.3,
          .seed = 5};  // maze
}

struct Scene {
  LaplaceDomain domain;
  VoxelIndex source;
  std::size_t unknowns;
};

Scene make_scene(const std::string& name) {
#ifdef VANTAGE_HAS_SIM
  static constexpr std::string_view kHouse = "house-";
  if (name.starts_with(kHouse)) {
    auto [domain, source] = house_scene(std::getenv("VANTAGE_DATA"), std::stoul(name.substr(kHouse.size())));
    return {std::move(domain), source, 0};
  }
#endif
  const RandomRooms rooms(options_of(name));
  return {rooms.domain(), rooms.source, 0};
}

const Scene& scene_of(const std::string& name) {
  static std::map<std::string, Scene> all;
  if (const auto found = all.find(name); found != all.end()) {
    return found->second;
  }
  Scene scene = make_scene(name);
  scene.domain.keep_component(scene.source);
  scene.unknowns = scene.domain.cell_count() - scene.domain.sink_count();
  return all.emplace(name, std::move(scene)).first->second;
}

void count(benchmark::State& state, const Scene& scene, double iterations) {
  state.counters["unknowns"] = static_cast<double>(scene.unknowns);
  state.counters["iterations"] = iterations;
  state.counters["per_cell"] =
      benchmark::Counter(static_cast<double>(scene.unknowns),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <std::size_t threads>
void multigrid(benchmark::State& state, const std::string& name) {
  const Scene& scene = scene_of(name);
  MultigridReport report;
  for (auto _ : state) {
    const LaplaceMultigrid field(scene.domain, scene.source, {.threads = threads});
    report = field.report();
  }
  if (!report.certified) {
    state.SkipWithError("not certified");
  }
  count(state, scene, static_cast<double>(report.iterations));
  state.counters["bytes_per_cell"] = static_cast<double>(report.memory_bytes) / static_cast<double>(scene.unknowns);
}

// Not a timing: the share of cells whose steepest neighbour differs without the uniform source (its cost), and the
// number of cells without lower neighbour then (its benefit).
void directions(benchmark::State& state, const std::string& name) {
  const Scene& scene = scene_of(name);
  const LaplaceMultigrid with(scene.domain, scene.source);
  const LaplaceMultigrid plain(scene.domain, scene.source, {.tolerance = 1e-10, .uniform_source = 0.0});
  std::size_t changed = 0;
  for (auto _ : state) {
    with.potential().domain().for_each_cell([&](const VoxelIndex& cell) {
      changed += steepest_neighbour(with.potential(), cell) != steepest_neighbour(plain.potential(), cell) ? 1U : 0U;
    });
  }
  state.counters["changed_%"] = 100.0 * static_cast<double>(changed) / static_cast<double>(scene.unknowns);
  state.counters["stuck_without"] = static_cast<double>(plain.report().stuck_cells);
}

// The paper's method with its own stopping rule, which leaves an error of some percent.
void gauss_seidel(benchmark::State& state, const std::string& name) {
  const Scene& scene = scene_of(name);
  const LaplaceProblem problem(scene.domain, scene.source);
  LaplaceReport report;
  for (auto _ : state) {
    report = relax_laplace(problem).report;
  }
  count(state, scene, static_cast<double>(report.sweeps));
}

void eigen_iccg(benchmark::State& state, const std::string& name) {
  const Scene& scene = scene_of(name);
  const LaplaceMatrix system = matrix_of(scene.domain, scene.source);
  double iterations = 0.0;
  for (auto _ : state) {
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::IncompleteCholesky<double>> solver;
    solver.setTolerance(1e-8);
    solver.compute(system.matrix);
    benchmark::DoNotOptimize(solver.solve(system.right).eval());
    iterations = static_cast<double>(solver.iterations());
  }
  count(state, scene, iterations);
}

#ifdef VANTAGE_HAS_HYPRE
void hypre_boomeramg(benchmark::State& state, const std::string& name) {
  const Scene& scene = scene_of(name);
  BoomerAmg solver(matrix_of(scene.domain, scene.source));
  double iterations = 0.0;
  for (auto _ : state) {
    iterations = static_cast<double>(solver.solve(1e-8));
  }
  count(state, scene, iterations);
}
#endif

void add(const std::string& solver, const std::vector<std::string>& scenes,
         void (*run)(benchmark::State&, const std::string&), int repetitions) {
  for (const std::string& scene : scenes) {
    auto* benchmark = benchmark::RegisterBenchmark(("field/" + solver + "/" + scene).c_str(),
                                                   [run, scene](benchmark::State& state) { run(state, scene); });
    benchmark->Unit(benchmark::kMillisecond);
    if (repetitions > 0) {
      benchmark->Iterations(repetitions);
    }
  }
}

const bool registered = [] {
  std::vector<std::string> all{"51-early", "51-middle", "51", "128", "256", "floor", "maze"};
#ifdef VANTAGE_HAS_SIM
  if (std::getenv("VANTAGE_DATA") != nullptr) {
    all.insert(all.end(), {"house-3", "house-30"});
  }
#endif
  add("multigrid", all, multigrid<1>, 0);
  add("multigrid2", {"51", "128", "256"}, multigrid<2>, 0);
  add("directions", all, directions, 1);
  add("gauss_seidel", {"51-early", "51-middle", "51"}, gauss_seidel, 1);
  add("eigen_iccg", all, eigen_iccg, 1);
#ifdef VANTAGE_HAS_HYPRE
  add("hypre_boomeramg", all, hypre_boomeramg, 1);
#endif
  return true;
}();

}  // namespace
}  // namespace vantage
