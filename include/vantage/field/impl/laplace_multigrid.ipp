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
// A refinement that reduces the residual by less than this factor is the last one.
inline constexpr double kProgress = 0.5;

// One solution: prepares the domain, then refines until it is good enough.
class MultigridRun {
 public:
  MultigridRun(const MultigridOptions& options, MultigridReport& report) : options_(options), report_(report) {}

  [[nodiscard]] Potential solve(LaplaceDomain domain, const VoxelIndex& source);

 private:
  void prepare(LaplaceDomain& domain, const VoxelIndex& source);
  [[nodiscard]] Defect refine(BrickSolver& solver, Refinement& refinement);
  [[nodiscard]] bool may_go_on(const Defect& defect, double last);
  // The factor by which the residual must still decrease: slightly below the tolerance at first. Then almost always
  // every cell has a lower neighbour, long before this is proven. If some cell has none, the residual must become
  // small enough for the proof.
  [[nodiscard]] double reduction_wanted(const Defect& defect) const {
    return defect.norm > options_.tolerance || options_.uniform_source == 0.0
               ? 0.8 * options_.tolerance / defect.norm
               : 0.5 * report_.source_per_cell / defect.largest;
  }
  [[nodiscard]] bool good_enough(const Defect& defect) const {
    return defect.norm <= options_.tolerance && defect.checked &&
           (defect.stuck == 0 || options_.uniform_source == 0.0);
  }

  const MultigridOptions& options_;
  MultigridReport& report_;
};

inline void MultigridRun::prepare(LaplaceDomain& domain, const VoxelIndex& source) {
  const LaplaceDomain::Dropped dropped = domain.keep_component(source);
  report_.dropped_cells = dropped.cells;
  report_.dropped_components = dropped.components;
  report_.sinks = domain.sink_count();
  report_.unknowns = domain.cell_count() - report_.sinks;
  if (domain.is_sink(source)) {
    throw std::invalid_argument("LaplaceMultigrid: the source (" + std::to_string(source.x) + ", " +
                                std::to_string(source.y) + ", " + std::to_string(source.z) + ") is a sink");
  }
}

inline Potential MultigridRun::solve(LaplaceDomain domain, const VoxelIndex& source) {
  auto started = Clock::now();
  prepare(domain, source);
  if (report_.sinks == 0) {
    report_.stop = MultigridStop::NoSinks;
    report_.stuck_cells = report_.unknowns;
    report_.setup_seconds = seconds_since(started);
    return {std::move(domain), source};
  }
  BrickSolver solver(make_fine_level(domain, options_.threads));
  report_.source_per_cell = options_.uniform_source / static_cast<double>(report_.unknowns);
  report_.levels = solver.level_count();
  Refinement refinement(solver.fine(), CellPlace(domain, source), report_.source_per_cell);
  report_.memory_bytes = domain.memory_bytes() + solver.memory_bytes() + refinement.memory_bytes();
  report_.setup_seconds = seconds_since(std::exchange(started, Clock::now()));
  const Defect defect = refine(solver, refinement);
  report_.residual = defect.norm;
  report_.largest_residual = defect.largest;
  report_.stuck_cells = defect.stuck;
  report_.certified = defect.stuck == 0;
  report_.solve_seconds = seconds_since(started);
  return {std::move(domain), source, refinement.take()};
}

// Whether another refinement is needed and may help. Otherwise sets the reason to stop.
inline bool MultigridRun::may_go_on(const Defect& defect, double last) {
  if (good_enough(defect)) {
    report_.stop = MultigridStop::Converged;
  } else if (report_.iterations >= options_.max_iterations) {
    report_.stop = MultigridStop::IterationLimit;
  } else if (!(defect.norm < kProgress * last)) {
    report_.stop = MultigridStop::Stalled;
  } else {
    return true;
  }
  return false;
}

inline Defect MultigridRun::refine(BrickSolver& solver, Refinement& refinement) {
  const FineLevel& fine = solver.fine();
  const double most = reduction_in_float(report_.unknowns);
  double unit = 1.0;
  const auto update = [&](double step, bool check) {
    return refinement.update(fine, {solver.solution(), step}, {solver.right(), unit}, check);
  };
  Defect defect = update(0.0, false);
  for (double last = std::numeric_limits<double>::infinity(); may_go_on(defect, last);) {
    last = defect.norm;
    const double wanted = reduction_wanted(defect);
    const double reduction = std::clamp(wanted, most, 0.25);
    report_.iterations += solver.solve(reduction, options_.max_iterations - report_.iterations);
    ++report_.refinements;
    // A check costs time, so it is skipped for a solution that will be refined further. If that solution meets the
    // tolerance after all, it is checked afterwards.
    defect = update(std::exchange(unit, reduction * last), wanted >= most);
    if (!defect.checked && defect.norm <= options_.tolerance) {
      defect = update(0.0, true);
    }
  }
  return defect.checked ? defect : update(0.0, true);
}

}  // namespace detail

VANTAGE_INLINE void MultigridOptions::validate() const {
  detail::require_option(tolerance > 0.0 && tolerance < 1.0, "MultigridOptions::tolerance", tolerance, "in (0, 1)");
  detail::require_option(uniform_source >= 0.0 && std::isfinite(uniform_source), "MultigridOptions::uniform_source",
                         uniform_source, ">= 0 and finite");
  detail::require_option(max_iterations > 0, "MultigridOptions::max_iterations", max_iterations, "> 0");
  detail::require_option(threads > 0, "MultigridOptions::threads", threads, "> 0");
}

VANTAGE_INLINE LaplaceMultigrid::LaplaceMultigrid(LaplaceDomain domain, const VoxelIndex& source,
                                                  const MultigridOptions& options) {
  options.validate();
  potential_ = detail::MultigridRun(options, report_).solve(std::move(domain), source);
}

VANTAGE_INLINE LaplaceMultigrid::LaplaceMultigrid(const LaplaceProblem& problem, const MultigridOptions& options)
    : LaplaceMultigrid(LaplaceDomain(problem), problem.cell(problem.source()), options) {}

}  // namespace vantage
