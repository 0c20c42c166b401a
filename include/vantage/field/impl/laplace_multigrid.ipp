// SPDX-License-Identifier: MIT
#pragma once

// Shade & Newman 2011, IV, by multigrid: McAdams, Sifakis, Teran 2010; Notay 2010.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/field/laplace_multigrid.hpp>

#include <vantage/field/impl/brick_solver.hpp>
#include <vantage/field/impl/mirror_solver.hpp>
#include <vantage/field/impl/refinement.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The largest reduction of the residual that one single-precision solve should reach before the residual is
// recomputed in double. Rounding of the solution adds noise to the residual, more in large domains. Conjugate
// gradients lose iterations on noise, so in large domains it pays to recompute earlier.
constexpr double reduction_in_float(std::size_t unknowns) { return unknowns < 500'000 ? 1e-4 : 4e-3; }
// The same limit for BiCGSTAB. There, only the preconditioner is in single precision.
inline constexpr double kMirrorReduction = 1e-4;
// BiCGSTAB restarts after this many iterations, before rounding destroys its recurrences.
inline constexpr std::size_t kMirrorIterations = 6;
// A refinement that reduces the residual by less than this factor is the last one.
inline constexpr double kProgress = 0.5;

}  // namespace detail

VANTAGE_INLINE void MultigridOptions::validate() const {
  detail::require_option(tolerance > 0.0 && tolerance < 1.0, "MultigridOptions::tolerance", tolerance, "in (0, 1)");
  detail::require_option(uniform_source >= 0.0 && std::isfinite(uniform_source), "MultigridOptions::uniform_source",
                         uniform_source, ">= 0 and finite");
  detail::require_option(max_iterations > 0, "MultigridOptions::max_iterations", max_iterations, "> 0");
  detail::require_option(threads > 0, "MultigridOptions::threads", threads, "> 0");
}

struct LaplaceMultigrid::State {
  LaplaceDomain domain;
  std::optional<detail::CellValues> solution;  // nullopt if there are no sinks
  MultigridReport report;

  void prepare(const VoxelIndex& source);
  void solve(const VoxelIndex& source, const MultigridOptions& options);
  detail::Defect refine(detail::BrickSolver& solver, detail::Refinement& refinement, const MultigridOptions& options);
  detail::Defect refine(detail::MirrorSolver& solver, const MultigridOptions& options);
  bool may_go_on(const detail::Defect& defect, double last, const MultigridOptions& options);
  void conclude(const detail::Defect& defect);
  // The factor by which the residual must still decrease: slightly below the tolerance at first. Then almost always
  // every cell has a lower neighbour, long before this is proven. If some cell has none, the residual must become
  // small enough for the proof.
  [[nodiscard]] double reduction_wanted(const detail::Defect& defect, const MultigridOptions& options) const {
    return defect.norm > options.tolerance || options.uniform_source == 0.0
               ? 0.8 * options.tolerance / defect.norm
               : 0.5 * report.source_per_cell / defect.largest;
  }
  [[nodiscard]] bool good_enough(const detail::Defect& defect, const MultigridOptions& options) const {
    return defect.norm <= options.tolerance && defect.checked && (defect.stuck == 0 || options.uniform_source == 0.0);
  }
};

VANTAGE_INLINE void LaplaceMultigrid::State::prepare(const VoxelIndex& source) {
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

VANTAGE_INLINE void LaplaceMultigrid::State::solve(const VoxelIndex& source, const MultigridOptions& options) {
  auto started = detail::Clock::now();
  prepare(source);
  if (report.sinks == 0) {
    report.stop = MultigridStop::NoSinks;
    report.stuck_cells = report.unknowns;
    report.setup_seconds = detail::seconds_since(started);
    return;
  }
  detail::BrickSolver solver(detail::make_fine_level(domain, options.threads));
  const detail::CellPlace place = detail::CellPlace::of(domain, source);
  report.source_per_cell = options.uniform_source / static_cast<double>(report.unknowns);
  report.levels = solver.level_count();
  report.memory_bytes = domain.memory_bytes() + solver.memory_bytes();
  if (options.neumann == NeumannScheme::FiniteVolume) {
    detail::Refinement refinement(solver.fine(), place, report.source_per_cell);
    report.memory_bytes += refinement.memory_bytes();
    report.setup_seconds = detail::seconds_since(std::exchange(started, detail::Clock::now()));
    conclude(refine(solver, refinement, options));
    solution = refinement.take();
  } else {
    detail::MirrorSolver mirror(domain, solver, place, report.source_per_cell);
    report.memory_bytes += mirror.memory_bytes();
    report.setup_seconds = detail::seconds_since(std::exchange(started, detail::Clock::now()));
    conclude(refine(mirror, options));
    solution = mirror.take();
  }
  report.solve_seconds = detail::seconds_since(started);
}

// Whether another refinement is needed and may help. Otherwise sets the reason to stop.
VANTAGE_INLINE bool LaplaceMultigrid::State::may_go_on(const detail::Defect& defect, double last,
                                                       const MultigridOptions& options) {
  if (good_enough(defect, options)) {
    report.stop = MultigridStop::Converged;
  } else if (report.iterations >= options.max_iterations) {
    report.stop = MultigridStop::IterationLimit;
  } else if (!(defect.norm < detail::kProgress * last)) {
    report.stop = MultigridStop::Stalled;
  } else {
    return true;
  }
  return false;
}

VANTAGE_INLINE detail::Defect LaplaceMultigrid::State::refine(detail::BrickSolver& solver,
                                                              detail::Refinement& refinement,
                                                              const MultigridOptions& options) {
  const detail::FineLevel& fine = solver.fine();
  const double most = detail::reduction_in_float(report.unknowns);
  double unit = 1.0;
  const auto update = [&](double step, bool check) {
    return refinement.update(fine, {solver.solution(), step}, {solver.right(), unit}, check);
  };
  detail::Defect defect = update(0.0, false);
  for (double last = std::numeric_limits<double>::infinity(); may_go_on(defect, last, options);) {
    last = defect.norm;
    const double wanted = reduction_wanted(defect, options);
    const double reduction = std::clamp(wanted, most, 0.25);
    report.iterations += solver.solve(reduction, options.max_iterations - report.iterations);
    ++report.refinements;
    // A check costs time, so it is skipped for a solution that will be refined further. If that solution meets the
    // tolerance after all, it is checked afterwards.
    defect = update(std::exchange(unit, reduction * last), wanted >= most);
    if (!defect.checked && defect.norm <= options.tolerance) {
      defect = update(0.0, true);
    }
  }
  return defect.checked ? defect : update(0.0, true);
}

VANTAGE_INLINE detail::Defect LaplaceMultigrid::State::refine(detail::MirrorSolver& solver,
                                                              const MultigridOptions& options) {
  detail::Defect defect = solver.defect();
  double last = std::numeric_limits<double>::infinity();
  for (double before_last = last; may_go_on(defect, before_last, options);) {
    before_last = std::exchange(last, defect.norm);
    const double wanted = std::clamp(reduction_wanted(defect, options), detail::kMirrorReduction, 0.25);
    report.iterations += solver.solve(
        wanted * defect.norm, std::min(detail::kMirrorIterations, options.max_iterations - report.iterations));
    ++report.refinements;
    defect = solver.defect();
  }
  return defect;
}

VANTAGE_INLINE void LaplaceMultigrid::State::conclude(const detail::Defect& defect) {
  report.residual = defect.norm;
  report.largest_residual = defect.largest;
  report.stuck_cells = defect.stuck;
  report.certified = defect.stuck == 0;
}

VANTAGE_INLINE LaplaceMultigrid::LaplaceMultigrid(LaplaceDomain domain, const VoxelIndex& source,
                                                  const MultigridOptions& options)
    : state_(std::make_unique<State>()) {
  options.validate();
  (void)best_instruction_set();  // may throw, which must not happen later in a worker thread
  state_->domain = std::move(domain);
  state_->solve(source, options);
}

VANTAGE_INLINE LaplaceMultigrid::LaplaceMultigrid(const LaplaceProblem& problem, const MultigridOptions& options)
    : LaplaceMultigrid(LaplaceDomain(problem), problem.cell(problem.source()), options) {}

VANTAGE_INLINE LaplaceMultigrid::LaplaceMultigrid(LaplaceMultigrid&&) noexcept = default;
VANTAGE_INLINE LaplaceMultigrid& LaplaceMultigrid::operator=(LaplaceMultigrid&&) noexcept = default;
VANTAGE_INLINE LaplaceMultigrid::~LaplaceMultigrid() = default;

VANTAGE_INLINE const MultigridReport& LaplaceMultigrid::report() const { return state_->report; }

VANTAGE_INLINE const LaplaceDomain& LaplaceMultigrid::domain() const { return state_->domain; }

VANTAGE_INLINE std::optional<double> LaplaceMultigrid::phi(const VoxelIndex& cell) const {
  if (!state_->domain.contains(cell)) {
    return std::nullopt;
  }
  return state_->solution ? state_->solution->at(detail::CellPlace::of(state_->domain, cell)) : 1.0;
}

VANTAGE_INLINE std::vector<double> LaplaceMultigrid::values(const LaplaceProblem& problem) const {
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
