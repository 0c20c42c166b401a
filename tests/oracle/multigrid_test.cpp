// SPDX-License-Identifier: MIT
// Multigrid against a direct solution and physical laws, in many random worlds.
#include <gtest/gtest.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/field/streamline.hpp>

#include <vantage/field/impl/brick_solver.hpp>
#include "random_laplace.hpp"
#include "random_rooms.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

using Position = LaplaceProblem::Position;

// A u = e_s + eps, u = 0 at the sinks, phi = u / u_s, from the definition.
std::vector<double> direct_solution(const LaplaceProblem& problem, double eps) {
  const auto n = static_cast<Eigen::Index>(problem.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto position = static_cast<Position>(i);
    if (problem.kind(position) == LaplaceCell::Sink) {
      entries.emplace_back(i, i, 1.0);
      continue;
    }
    b(i) = eps + (position == problem.source() ? 1.0 : 0.0);
    for (const VoxelIndex& step : kFaceNeighbours) {
      if (const auto neighbour = problem.position_of(problem.cell(position) + step)) {
        entries.emplace_back(i, i, 1.0);
        entries.emplace_back(i, static_cast<Eigen::Index>(*neighbour), -1.0);
      }
    }
  }
  Eigen::SparseMatrix<double> a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(a);
  if (lu.info() != Eigen::Success) {
    throw std::runtime_error("the operator is singular");
  }
  const Eigen::VectorXd u = lu.solve(b);
  std::vector<double> phi(problem.size());
  for (std::size_t i = 0; i < phi.size(); ++i) {
    phi[i] = u(static_cast<Eigen::Index>(i)) / u(static_cast<Eigen::Index>(problem.source()));
  }
  return phi;
}

TEST(MultigridOracle, EqualsADirectSolutionOfTinyWorlds) {
  std::mt19937 engine(21);
  constexpr std::size_t kWorlds = test::kSanitized ? 200 : 600;
  std::size_t cases = 0;
  std::size_t cells = 0;
  for (std::size_t world = 0; world < kWorlds; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    const double uniform_source = world % 2 == 0 ? 1e-4 : 1e-2;
    const LaplaceMultigrid field(problem, {.tolerance = 1e-13, .uniform_source = uniform_source});
    ASSERT_EQ(field.report().stop, MultigridStop::Converged) << "world " << world;
    const std::vector<double> phi = values_of(field.potential(), problem);
    const std::vector<double> expected = direct_solution(problem, field.report().source_per_cell);
    for (std::size_t i = 0; i < problem.size(); ++i) {
      ASSERT_NEAR(phi[i], expected[i], 1e-11) << "world " << world << " cell " << i << " of " << problem.size();
    }
    ASSERT_EQ(count_stuck_cells(field.potential()), 0U) << "world " << world;
    ++cases;
    cells += problem.size();
  }
  EXPECT_GE(cases, 3 * kWorlds / 4);
  EXPECT_GE(cells, 25 * kWorlds);
}

TEST(MultigridOracle, EqualsADirectSolutionOfRooms) {
  std::size_t cells = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const RandomRooms rooms({.extent = {20, 17, 23},
                             .room_cells = seed % 2 == 0 ? 9 : 6,
                             .door_cells = 2,
                             .doors = 0.8,
                             .clutter = 0.001,
                             .seed = seed});
    const LaplaceProblem problem = rooms.problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    const LaplaceMultigrid field(problem, {.tolerance = 1e-12, .uniform_source = 0.0});
    const std::vector<double> expected = direct_solution(problem, 0.0);
    ASSERT_EQ(field.report().stop, MultigridStop::Converged) << "seed " << seed << " " << field.report().residual;
    const std::vector<double> phi = values_of(field.potential(), problem);
    for (std::size_t i = 0; i < problem.size(); ++i) {
      ASSERT_NEAR(phi[i], expected[i], 1e-9) << "seed " << seed;
    }
    cells += problem.size();
  }
  EXPECT_GE(cells, 12500U);
}

struct Worlds {
  const char* name;
  RoomsOptions options;
};

std::vector<Worlds> kinds_of_worlds() {
  return {
      {"rooms", {.extent = {51, 51, 51}, .room_cells = 25, .door_cells = 6}},
      {"small rooms", {.extent = {40, 56, 33}, .room_cells = 11, .door_cells = 3}},
      {"thin walls, doors of a cell", {.extent = {37, 37, 37}, .room_cells = 6, .door_cells = 1, .doors = 0.5}},
      {"maze of corridors", {.extent = {41, 41, 41}, .room_cells = 4, .door_cells = 2, .doors = 0.45}},
      {"maze one cell wide",
       {.extent = {35, 35, 35}, .room_cells = 2, .door_cells = 1, .doors = 0.5, .unexplored = 0.5}},
      {"crowded", {.extent = {45, 45, 45}, .room_cells = 60, .wall_cells = 0, .clutter = 0.03, .unexplored = 0.2}},
      {"hardly explored", {.extent = {51, 51, 51}, .room_cells = 17, .unexplored = 0.7}},
      {"slab", {.extent = {90, 70, 3}, .room_cells = 12, .door_cells = 2, .wall_cells = 1, .doors = 1.0}},
  };
}

// Descends from every cell. Returns the number of cells from which no sink is reached.
std::size_t walks_that_fail(const LaplaceProblem& problem, const Potential& potential) {
  const std::vector<double> phi = values_of(potential, problem);
  std::vector<Position> by_height(problem.size());
  std::iota(by_height.begin(), by_height.end(), Position{0});
  std::sort(by_height.begin(), by_height.end(), [&](Position a, Position b) {
    return phi[static_cast<std::size_t>(a)] < phi[static_cast<std::size_t>(b)];
  });
  // A step leads strictly down, so the result of its end is already known.
  std::vector<bool> arrives(problem.size(), false);
  for (const Position from : by_height) {
    const auto next = steepest_neighbour(potential, problem.cell(from));
    arrives[static_cast<std::size_t>(from)] =
        problem.kind(from) == LaplaceCell::Sink ||
        (next && arrives[static_cast<std::size_t>(*problem.position_of(*next))]);
  }
  return static_cast<std::size_t>(std::count(arrives.begin(), arrives.end(), false));
}

TEST(MultigridOracle, TheWayDownFromEveryCellEndsAtASink) {
  std::size_t worlds = 0;
  std::size_t cells = 0;
  std::size_t worlds_stuck_without = 0;
  for (const Worlds& kind : kinds_of_worlds()) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
      RoomsOptions options = kind.options;
      options.seed = seed;
      const LaplaceProblem problem = RandomRooms(options).problem();
      if (problem.sink_count() == 0) {
        continue;
      }
      const LaplaceMultigrid field(problem);
      ASSERT_EQ(field.report().stop, MultigridStop::Converged) << kind.name << " " << seed;
      ASSERT_TRUE(field.report().certified) << kind.name << " " << seed;
      ASSERT_LT(field.report().largest_residual, field.report().source_per_cell) << kind.name << " " << seed;
      const std::vector<double> phi = values_of(field.potential(), problem);
      ASSERT_EQ(count_stuck_cells(field.potential()), 0U) << kind.name << " " << seed;
      ASSERT_EQ(walks_that_fail(problem, field.potential()), 0U) << kind.name << " " << seed;
      ASSERT_TRUE(descend(field.potential(), problem.cell(problem.source())).reaches_sink);
      const auto [low, high] =
          std::minmax_element(phi.begin(), phi.end());  // the maximum principle, except at the source
      ASSERT_GE(*low, 0.0);
      ASSERT_LE(*high, 1.0 + 1e-3) << kind.name << " " << seed;
      ++worlds;
      cells += problem.size();
      if (seed == 1) {  // without the uniform source, the count must find stuck cells
        const LaplaceMultigrid plain(problem, {.uniform_source = 0.0});
        // Where phi underflows and is not positive, the solver certifies no cell.
        EXPECT_GE(plain.report().stuck_cells, count_stuck_cells(plain.potential())) << kind.name;
        EXPECT_EQ(plain.report().certified, plain.report().stuck_cells == 0);
        worlds_stuck_without += walks_that_fail(problem, plain.potential()) > 0 ? 1U : 0U;
      }
    }
  }
  EXPECT_GE(worlds, 40U);
  EXPECT_GE(cells, 1000000U);
  EXPECT_GE(worlds_stuck_without, 3U);
}

// Flux out of the source cell, where phi is 1: 1 / u_s.
double flux_of_source(const LaplaceProblem& problem, std::span<const double> phi) {
  double flux = 0.0;
  for (const Position neighbour : problem.neighbours(problem.source())) {
    flux += neighbour == LaplaceProblem::kClosed ? 0.0 : 1.0 - phi[static_cast<std::size_t>(neighbour)];
  }
  return flux;
}

TEST(MultigridOracle, FluxIsTheSameThroughEveryCutBetweenSourceAndSinks) {
  std::size_t cuts = 0;
  for (const Worlds& kind : kinds_of_worlds()) {
    const LaplaceProblem problem = RandomRooms(kind.options).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    const LaplaceMultigrid field(problem, {.tolerance = 1e-11, .uniform_source = 0.0});
    const std::vector<double> phi = values_of(field.potential(), problem);
    const auto flux_across = [&](double level) {
      double flux = 0.0;
      for (std::size_t i = 0; i < problem.size(); ++i) {
        for (const Position neighbour : problem.neighbours(static_cast<Position>(i))) {
          if (neighbour != LaplaceProblem::kClosed && phi[i] > level &&
              phi[static_cast<std::size_t>(neighbour)] <= level) {
            flux += phi[i] - phi[static_cast<std::size_t>(neighbour)];
          }
        }
      }
      return flux;
    };
    const double out_of_source = flux_of_source(problem, phi);
    for (const double level : {1e-3, 0.05, 0.2, 0.5, 0.9}) {
      ASSERT_NEAR(flux_across(level) / out_of_source, 1.0, 1e-6) << kind.name << " level " << level;
      ++cuts;
    }
  }
  EXPECT_GE(cuts, 35U);
}

// The boundary of any set of cells that contains the source and no sink: the flux out of it equals the flux of the
// source plus that of the uniform source in these cells.
TEST(MultigridOracle, FluxThroughAnyClosedSurfaceIsWhatItEncloses) {
  std::mt19937 engine(24);
  std::size_t surfaces = 0;
  for (const Worlds& kind : kinds_of_worlds()) {
    const LaplaceProblem problem = RandomRooms(kind.options).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    for (const double uniform_source : {0.0, 0.3}) {
      const LaplaceMultigrid field(problem, {.tolerance = 1e-11, .uniform_source = uniform_source});
      const std::vector<double> phi = values_of(field.potential(), problem);
      const double eps = field.report().source_per_cell;
      const double unit = flux_of_source(problem, phi) / (1.0 + eps);  // 1 / u_s
      if (uniform_source == 0.0) {                                     // the maximum principle
        ASSERT_GE(*std::min_element(phi.begin(), phi.end()), -1e-9) << kind.name;
        ASSERT_LE(*std::max_element(phi.begin(), phi.end()), 1.0 + 1e-9) << kind.name;
      }
      for (const double density : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        std::bernoulli_distribution is_in(density);
        std::vector<bool> inside(problem.size());
        double enclosed = 1.0;
        for (std::size_t i = 0; i < problem.size(); ++i) {
          const auto position = static_cast<Position>(i);
          inside[i] = position == problem.source() || (problem.kind(position) != LaplaceCell::Sink && is_in(engine));
          enclosed += inside[i] ? eps : 0.0;
        }
        double flux = 0.0;
        for (std::size_t i = 0; i < problem.size(); ++i) {
          for (const Position neighbour : problem.neighbours(static_cast<Position>(i))) {
            if (inside[i] && neighbour != LaplaceProblem::kClosed && !inside[static_cast<std::size_t>(neighbour)]) {
              flux += phi[i] - phi[static_cast<std::size_t>(neighbour)];
            }
          }
        }
        ASSERT_NEAR(flux / unit, enclosed, 1e-6) << kind.name << " " << density << " " << uniform_source;
        ++surfaces;
      }
    }
  }
  EXPECT_GE(surfaces, 70U);
}

// Reciprocity: source and receiver may be exchanged.
TEST(MultigridOracle, SourceAndReceiverMayBeExchanged) {
  std::mt19937 engine(25);
  std::size_t pairs = 0;
  for (const Worlds& kind : kinds_of_worlds()) {
    const RandomRooms rooms(kind.options);
    const LaplaceProblem problem = rooms.problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    std::uniform_int_distribution<Position> any(0, static_cast<Position>(problem.size()) - 1);
    Position receiver = problem.source();
    while (receiver == problem.source() || problem.kind(receiver) == LaplaceCell::Sink) {
      receiver = any(engine);
    }
    const LaplaceProblem exchanged(rooms.cells, rooms.sinks, problem.cell(receiver));
    const MultigridOptions exact{.tolerance = 1e-11, .uniform_source = 0.0};
    const std::vector<double> there = values_of(LaplaceMultigrid(problem, exact).potential(), problem);
    const std::vector<double> back = values_of(LaplaceMultigrid(exchanged, exact).potential(), exchanged);
    const double forward = there[static_cast<std::size_t>(receiver)] / flux_of_source(problem, there);
    const auto sensor = static_cast<std::size_t>(*exchanged.position_of(problem.cell(problem.source())));
    EXPECT_NEAR(back[sensor] / flux_of_source(exchanged, back), forward, 1e-8) << kind.name;
    ++pairs;
  }
  EXPECT_GE(pairs, 7U);
}

// The operator of the black cells and the preconditioner, as conjugate gradients use them.
TEST(MultigridOracle, OperatorAndPreconditionerAreSymmetricAndPositive) {
  std::mt19937 engine(22);
  std::normal_distribution<float> normal;
  std::size_t cases = 0;
  for (const Worlds& kind : kinds_of_worlds()) {
    const RandomRooms rooms(kind.options);
    LaplaceDomain domain = rooms.domain();
    domain.keep_component(rooms.source);
    if (domain.sink_count() == 0) {
      continue;
    }
    detail::BrickSolver solver(detail::make_fine_level(domain));
    const auto random_field = [&] {
      detail::HalfField<float> field(solver.right().size(), 0.0F);
      for (std::size_t i = 0; i < field.size(); ++i) {
        field[i] = solver.fine().degree(detail::kBlack, i / detail::kHalfBrick, i % detail::kHalfBrick) > 0
                       ? normal(engine)
                       : 0.0F;
      }
      return field;
    };
    const auto dot = [](const detail::HalfField<float>& a, const detail::HalfField<float>& b) {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    for (int trial = 0; trial < 4; ++trial, ++cases) {
      const detail::HalfField<float> a = random_field();
      const detail::HalfField<float> b = random_field();
      detail::HalfField<float> of_a;
      detail::HalfField<float> of_b;
      solver.apply(a, of_a);
      solver.apply(b, of_b);
      EXPECT_GT(dot(a, of_a), 0.0) << kind.name;
      EXPECT_NEAR(dot(a, of_b), dot(b, of_a), 1e-5 * std::sqrt(dot(a, of_a) * dot(b, of_b))) << kind.name;
      solver.right() = a;
      solver.precondition(of_a);
      solver.right() = b;
      solver.precondition(of_b);
      EXPECT_GT(dot(a, of_a), 0.0) << kind.name;
      EXPECT_NEAR(dot(a, of_b), dot(b, of_a), 1e-5 * std::sqrt(dot(a, of_a) * dot(b, of_b))) << kind.name;
    }
  }
  EXPECT_GE(cases, 28U);
}

// The same bits in every run and with every instruction set.
TEST(MultigridOracle, EveryInstructionSetComputesTheSameBits) {
  const RandomRooms rooms({.seed = 5});
  LaplaceDomain domain = rooms.domain();
  domain.keep_component(rooms.source);
  const auto solution_with = [&](detail::InstructionSet set) {
    detail::FineLevel fine = detail::make_fine_level(domain);
    fine.set = set;
    detail::BrickSolver solver(std::move(fine));
    std::mt19937 engine(23);
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < solver.right().size(); ++i) {
      const bool is_unknown =
          solver.fine().degree(detail::kBlack, i / detail::kHalfBrick, i % detail::kHalfBrick) > 0;
      solver.right()[i] = is_unknown ? normal(engine) : 0.0F;
    }
    EXPECT_GE(solver.fine().brick_count, 51U);
    EXPECT_GT(solver.solve(1e-4, 30), 3U);
    return solver.solution();
  };
  const detail::HalfField<float> baseline = solution_with(detail::InstructionSet::Baseline);
  for (const detail::InstructionSet set : detail::instruction_sets()) {
    const detail::HalfField<float> solution = solution_with(set);
    ASSERT_EQ(std::memcmp(solution.data(), baseline.data(), baseline.size() * sizeof(float)), 0);
  }
  const auto solved = [&] {
    return values_of(LaplaceMultigrid(rooms.domain(), rooms.source).potential(), rooms.problem());
  };
  EXPECT_EQ(solved(), solved());
}

// Many borders between the shares of threads: from worlds with fewer bricks than threads to worlds that keep all
// threads busy on the first coarse levels.
TEST(MultigridOracle, AnyNumberOfThreadsComputesTheSameBits) {
  std::vector<Worlds> worlds = kinds_of_worlds();
  worlds.push_back({"one brick", {.extent = {12, 7, 8}, .room_cells = 12}});
  if (!test::kSanitized) {
    worlds.push_back({"large", {.extent = {120, 100, 90}, .room_cells = 23, .door_cells = 6}});
    worlds.push_back({"large maze", {.extent = {110, 95, 60}, .room_cells = 7, .door_cells = 3}});
  }
  std::size_t cases = 0;
  std::size_t largest = 0;
  for (const Worlds& kind : worlds) {
    const RandomRooms rooms(kind.options);
    const LaplaceProblem problem = rooms.problem();
    const LaplaceMultigrid alone(rooms.domain(), rooms.source);
    const std::vector<double> expected = values_of(alone.potential(), problem);
    for (const std::size_t threads : {2U, 3U, 7U}) {
      const LaplaceMultigrid field(rooms.domain(), rooms.source, {.threads = threads});
      ASSERT_EQ(values_of(field.potential(), problem), expected) << kind.name << ", " << threads;
      ASSERT_EQ(field.report().iterations, alone.report().iterations);
      ASSERT_EQ(field.report().residual, alone.report().residual);
      ++cases;
    }
    largest = std::max(largest, alone.report().unknowns);
  }
  EXPECT_EQ(cases, test::kSanitized ? 27U : 33U);
  EXPECT_GE(largest, test::kSanitized ? 10000U : 500000U);
}

}  // namespace
}  // namespace vantage
