// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vantage/field/harmonic_field.hpp>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/field/streamline.hpp>

namespace vantage {
namespace detail {

// Whether steepest descent from the source ends at a sink, as `descend` does in a Potential.
inline bool source_reaches_sink(const LaplaceProblem& problem, std::span<const double> phi) {
  LaplaceProblem::Position at = problem.source();
  while (problem.kind(at) != LaplaceCell::Sink) {
    LaplaceProblem::Position lowest = at;
    for (const LaplaceProblem::Position next : problem.neighbours(at)) {
      if (next != LaplaceProblem::kClosed &&
          phi[static_cast<std::size_t>(next)] < phi[static_cast<std::size_t>(lowest)]) {
        lowest = next;
      }
    }
    if (lowest == at) {
      return false;
    }
    at = lowest;
  }
  return true;
}

// Only a certified field is followed: then descent from every cell ends at a sink.
inline HarmonicField field_by_multigrid(LaplaceDomain domain, const VoxelIndex& source,
                                        const HarmonicFieldOptions& options, std::size_t threads) {
  LaplaceMultigrid multigrid(std::move(domain), source,
                             {.uniform_source = options.uniform_source, .threads = threads});
  const MultigridReport& report = multigrid.report();
  HarmonicField field;
  field.stuck_cells = report.stuck_cells;
  field.followed = report.certified;
  field.sweeps = report.iterations;
  field.cell_updates = report.iterations * report.unknowns;
  field.potential = std::move(multigrid).take();
  return field;
}

// The stopping rule of the paper does not guarantee that descent reaches a sink, so the relaxation continues until it
// does or max_sweeps is reached.
inline HarmonicField field_by_relaxation(LaplaceDomain domain, const VoxelIndex& source,
                                         const HarmonicFieldOptions& options) {
  const LaplaceProblem problem(std::move(domain), source);
  LaplaceRelaxation relaxation(problem, {.neumann = options.neumann,
                                         .tolerance = options.tolerance,
                                         .max_sweeps = options.max_sweeps,
                                         .uniform_source = options.uniform_source});
  relaxation.run();
  HarmonicField field;
  while (!(field.followed = source_reaches_sink(problem, relaxation.phi())) &&
         relaxation.report().sweeps < options.max_sweeps) {
    const std::size_t left = options.max_sweeps - relaxation.report().sweeps;
    relaxation.run(std::min(left, std::max<std::size_t>(relaxation.report().sweeps, 10)));
  }
  field.sweeps = relaxation.report().sweeps;
  field.cell_updates = relaxation.report().cell_updates;
  field.potential = Potential(problem, relaxation.phi());
  field.stuck_cells = count_stuck_cells(field.potential);
  return field;
}

}  // namespace detail

VANTAGE_INLINE HarmonicField HarmonicField::solve(LaplaceDomain domain, const VoxelIndex& source,
                                                  const HarmonicFieldOptions& options, std::size_t threads) {
  return options.solver == FieldSolver::Multigrid
             ? detail::field_by_multigrid(std::move(domain), source, options, threads)
             : detail::field_by_relaxation(std::move(domain), source, options);
}

VANTAGE_INLINE std::vector<VoxelIndex> HarmonicField::follow(const VoxelFrame& frame,
                                                             const Eigen::Vector3d& position) {
  const VoxelIndex& source = potential.source();
  std::vector<VoxelIndex> cells;
  if (auto curve = vantage::streamline(potential, frame,
                                       frame.cell_of(position) == source ? position : frame.centre_of(source))) {
    for (const Eigen::Vector3d& point : *curve) {
      if (const VoxelIndex cell = frame.cell_of(point); cells.empty() || cells.back() != cell) {
        cells.push_back(cell);
      }
    }
    streamline = std::move(*curve);
    streamline.push_back(frame.centre_of(cells.back()));
    return cells;
  }
  cells = descend(potential, source).cells;
  for (const VoxelIndex& cell : cells) {
    streamline.push_back(frame.centre_of(cell));
  }
  return cells;
}

}  // namespace vantage
