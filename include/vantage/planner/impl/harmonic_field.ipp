// SPDX-License-Identifier: MIT
#pragma once

// How HarmonicPlanner solves its field (Shade & Newman 2011, eq. 8 to 10).
#include <algorithm>
#include <utility>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/field/streamline.hpp>
#include <vantage/planner/harmonic_planner.hpp>

namespace vantage {
namespace detail {

inline RelaxationOptions relaxation_options(const HarmonicOptions& options) {
  RelaxationOptions relaxation;
  relaxation.neumann = options.neumann;
  relaxation.order = options.solver == FieldSolver::GaussSeidel ? SweepOrder::Lexicographic : SweepOrder::RedBlack;
  relaxation.tolerance = options.tolerance;
  relaxation.max_sweeps = options.max_sweeps;
  relaxation.uniform_source = options.uniform_source;
  return relaxation;
}

inline MultigridOptions multigrid_options(const HarmonicOptions& options, int threads) {
  MultigridOptions multigrid;
  multigrid.uniform_source = options.uniform_source;
  multigrid.threads = static_cast<std::size_t>(threads);
  return multigrid;
}

}  // namespace detail

VANTAGE_INLINE void HarmonicPlanner::solve(const NearGoals& near, PlanStatistics& statistics) {
  LaplaceDomain domain;
  near.met.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) { domain.insert(brick, cells); });
  std::for_each(near.goals.begin(), near.goals.end(), [&](const VoxelIndex& goal) { domain.insert_sink(goal); });
  const VoxelIndex& source = *situation().reachable().start();
  field_.emplace();
  if (options_.solver == FieldSolver::Multigrid) {
    solve_by_multigrid(std::move(domain), source);
  } else {
    relax(domain, near.goals, source);
  }
  statistics.solver_sweeps += field_->report.sweeps;
  statistics.ray_operations += field_->report.cell_updates;
}

// Only a certified field is followed: then descent from every cell ends at a sink.
VANTAGE_INLINE void HarmonicPlanner::solve_by_multigrid(LaplaceDomain domain, const VoxelIndex& source) {
  LaplaceMultigrid multigrid(std::move(domain), source,
                             detail::multigrid_options(options_, situation().setup().threads));
  const MultigridReport& report = multigrid.report();
  field_->stuck_cells = report.stuck_cells;
  field_->followed = report.certified;
  field_->report.stop = report.stop == MultigridStop::Converged ? LaplaceStop::Converged : LaplaceStop::SweepLimit;
  field_->report.sweeps = report.iterations;
  field_->report.cell_updates = report.iterations * report.unknowns;
  field_->report.seconds = report.setup_seconds + report.solve_seconds;
  field_->potential = std::move(multigrid).take();
}

VANTAGE_INLINE void HarmonicPlanner::relax(const LaplaceDomain& domain, const std::vector<VoxelIndex>& sinks,
                                           const VoxelIndex& source) {
  std::vector<VoxelIndex> cells;
  domain.for_each_cell([&](const VoxelIndex& cell) { cells.push_back(cell); });
  const LaplaceProblem problem(std::move(cells), sinks, source);
  LaplaceRelaxation relaxation(problem, detail::relaxation_options(options_));
  relaxation.run();
  // The stopping rule of the paper does not guarantee that descent reaches a sink, so the relaxation continues until
  // it does or max_sweeps is reached.
  const auto arrives = [&] {
    field_->potential = Potential(problem, relaxation.phi());
    return descend(field_->potential, source).reaches_sink;
  };
  while (!(field_->followed = arrives()) && relaxation.report().sweeps < options_.max_sweeps) {
    const std::size_t left = options_.max_sweeps - relaxation.report().sweeps;
    relaxation.run(std::min(left, std::max<std::size_t>(relaxation.report().sweeps, 10)));
  }
  field_->report = relaxation.report();
  field_->stuck_cells = count_stuck_cells(field_->potential);
}

}  // namespace vantage
