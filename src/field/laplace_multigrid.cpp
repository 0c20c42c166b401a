// SPDX-License-Identifier: MIT
// Shade & Newman 2011, IV, by multigrid: McAdams, Sifakis, Teran 2010; Notay 2010.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/field/laplace_multigrid.hpp>

#include "field/brick_solver.hpp"
#include "field/refinement.hpp"
#include "map/option_rule.hpp"

namespace vantage {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// The most a solution in float is asked to reduce the residual before it is taken again in double.
constexpr double kReduction = 1e-4;
// A refinement that does not reduce the residual by this much is one too many.
constexpr double kProgress = 0.5;

}  // namespace

void MultigridOptions::validate() const {
  detail::require_option(tolerance > 0.0 && tolerance < 1.0, "MultigridOptions::tolerance", tolerance, "in (0, 1)");
  detail::require_option(uniform_source >= 0.0 && std::isfinite(uniform_source), "MultigridOptions::uniform_source",
                         uniform_source, ">= 0 and finite");
  detail::require_option(max_iterations > 0, "MultigridOptions::max_iterations", max_iterations, "> 0");
}

struct LaplaceMultigrid::State {
  LaplaceDomain domain;
  std::optional<detail::Refinement> solution;  // none: no sinks
  MultigridReport report;

  void prepare(const VoxelIndex& source);
  void solve(const VoxelIndex& source, const MultigridOptions& options);
  void refine(detail::BrickSolver& solver, const MultigridOptions& options);
  [[nodiscard]] bool good_enough(const detail::Defect& defect, const MultigridOptions& options) const {
    return defect.norm <= options.tolerance && (defect.stuck == 0 || options.uniform_source == 0.0);
  }
};

void LaplaceMultigrid::State::prepare(const VoxelIndex& source) {
  const LaplaceDomain::Dropped dropped = domain.keep_component(source);
  report.dropped_cells = dropped.cells;
  report.dropped_components = dropped.components;
  report.sinks = domain.sink_count();
  report.unknowns = domain.cell_count() - report.sinks;
  const LaplaceDomain::Brick& brick = domain.bricks()[domain.position_of_brick(source)];
  if ((brick.sinks[LaplaceDomain::row_of(source)] & LaplaceDomain::bit_of(source)) != 0) {
    throw std::invalid_argument("LaplaceMultigrid: the source (" + std::to_string(source.x) + ", " +
                                std::to_string(source.y) + ", " + std::to_string(source.z) + ") is a sink");
  }
}

void LaplaceMultigrid::State::solve(const VoxelIndex& source, const MultigridOptions& options) {
  auto started = Clock::now();
  prepare(source);
  if (report.sinks == 0) {
    report.stop = MultigridStop::NoSinks;
    report.stuck_cells = report.unknowns;
    report.setup_seconds = seconds_since(started);
    return;
  }
  detail::BrickSolver solver(detail::make_fine_level(domain));
  report.source_per_cell = options.uniform_source / static_cast<double>(report.unknowns);
  solution.emplace(solver.fine(), detail::CellPlace::of(domain, source), report.source_per_cell);
  report.levels = solver.level_count();
  report.memory_bytes = domain.memory_bytes() + solver.memory_bytes() + solution->memory_bytes();
  report.setup_seconds = seconds_since(std::exchange(started, Clock::now()));
  refine(solver, options);
  report.solve_seconds = seconds_since(started);
}

void LaplaceMultigrid::State::refine(detail::BrickSolver& solver, const MultigridOptions& options) {
  const detail::FineLevel& fine = solver.fine();
  detail::Defect defect = solution->update(fine, solver.solution(), 0.0);
  double last = 2.0 * defect.norm / kProgress;
  while (!good_enough(defect, options)) {
    if (report.iterations >= options.max_iterations) {
      report.stop = MultigridStop::IterationLimit;
      break;
    }
    if (!(defect.norm < kProgress * last)) {
      report.stop = MultigridStop::Stalled;
      break;
    }
    last = defect.norm;
    const double wanted = 0.5 * std::min(options.tolerance / defect.norm,
                                         defect.largest > 0.0 && options.uniform_source > 0.0
                                             ? report.source_per_cell / defect.largest
                                             : 1.0);
    solution->residual(fine, 1.0 / defect.norm, solver.right());
    report.iterations += solver.solve(std::clamp(wanted, kReduction, 0.1), options.max_iterations - report.iterations);
    ++report.refinements;
    defect = solution->update(fine, solver.solution(), defect.norm);
  }
  if (good_enough(defect, options)) {
    report.stop = MultigridStop::Converged;
  }
  report.residual = defect.norm;
  report.largest_residual = defect.largest;
  report.stuck_cells = defect.stuck;
  report.certified = defect.stuck == 0;
}

LaplaceMultigrid::LaplaceMultigrid(LaplaceDomain domain, const VoxelIndex& source, const MultigridOptions& options)
    : state_(std::make_unique<State>()) {
  options.validate();
  state_->domain = std::move(domain);
  state_->solve(source, options);
}

LaplaceMultigrid::LaplaceMultigrid(const LaplaceProblem& problem, const MultigridOptions& options)
    : LaplaceMultigrid(LaplaceDomain(problem), problem.cell(problem.source()), options) {}

LaplaceMultigrid::LaplaceMultigrid(LaplaceMultigrid&&) noexcept = default;
LaplaceMultigrid& LaplaceMultigrid::operator=(LaplaceMultigrid&&) noexcept = default;
LaplaceMultigrid::~LaplaceMultigrid() = default;

const MultigridReport& LaplaceMultigrid::report() const { return state_->report; }

const LaplaceDomain& LaplaceMultigrid::domain() const { return state_->domain; }

std::optional<double> LaplaceMultigrid::phi(const VoxelIndex& cell) const {
  if (!state_->domain.contains(cell)) {
    return std::nullopt;
  }
  return state_->solution ? state_->solution->value(detail::CellPlace::of(state_->domain, cell)) : 1.0;
}

std::vector<double> LaplaceMultigrid::values(const LaplaceProblem& problem) const {
  std::vector<double> all;
  all.reserve(problem.size());
  for (const VoxelIndex& cell : problem.cells()) {
    const std::optional<double> one = phi(cell);
    if (!one) {
      throw std::invalid_argument("LaplaceMultigrid: a cell of the problem is not in the sensor's component");
    }
    all.push_back(*one);
  }
  return all;
}

}  // namespace vantage
