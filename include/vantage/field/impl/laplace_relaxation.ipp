// SPDX-License-Identifier: MIT
#pragma once

// Shade & Newman 2011, "Choosing Where To Go: Complete 3D Exploration With Stereo", section IV-C.
#include <cmath>
#include <vantage/field/laplace_relaxation.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
VANTAGE_INLINE void RelaxationOptions::validate() const {
  detail::require_option(tolerance > 0.0, "RelaxationOptions::tolerance", tolerance, "> 0");
  detail::require_option(max_sweeps > 0, "RelaxationOptions::max_sweeps", max_sweeps, "> 0");
  detail::require_option(uniform_source >= 0.0 && std::isfinite(uniform_source), "RelaxationOptions::uniform_source",
                         uniform_source, ">= 0 and finite");
}

VANTAGE_INLINE LaplaceRelaxation::LaplaceRelaxation(const LaplaceProblem& problem, const RelaxationOptions& options)
    : problem_(&problem), options_(options), values_(problem.size() + 1, 0.0) {
  options_.validate();
  values_[static_cast<std::size_t>(problem.source())] = 1.0;
  const auto size = static_cast<LaplaceProblem::Position>(problem.size());
  rows_.reserve(problem.size());
  for (LaplaceProblem::Position position = 0; position < size; ++position) {
    // A cell without an open face is alone in its component, so it is the source.
    if (problem.kind(position) == LaplaceCell::Interior) {
      rows_.push_back(row_of(position));
    }
  }
  source_per_cell_ = rows_.empty() ? 0.0 : options_.uniform_source / static_cast<double>(rows_.size());
}

VANTAGE_INLINE LaplaceRelaxation::Row LaplaceRelaxation::row_of(LaplaceProblem::Position position) const {
  const auto nothing = static_cast<LaplaceProblem::Position>(problem_->size());
  Row row{problem_->neighbours(position), position, 0.0};
  int terms = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    if (row.neighbours[face] != LaplaceProblem::kClosed) {
      ++terms;
      continue;
    }
    const LaplaceProblem::Position opposite = problem_->neighbours(position)[face ^ 1U];
    if (options_.neumann == NeumannScheme::Mirror && opposite != LaplaceProblem::kClosed) {
      row.neighbours[face] = opposite;  // eq. 9
      ++terms;
    } else {
      row.neighbours[face] = nothing;  // both faces of an axis are closed, so phi does not vary along it
    }
  }
  row.weight = 1.0 / terms;
  return row;
}

VANTAGE_INLINE double LaplaceRelaxation::mean_of(const Row& row) const {
  const auto value = [this](LaplaceProblem::Position position) {
    return values_[static_cast<std::size_t>(position)];
  };
  const auto& n = row.neighbours;
  return row.weight * ((value(n[0]) + value(n[1])) + (value(n[2]) + value(n[3])) + (value(n[4]) + value(n[5])) +
                       source_per_cell_);  // eq. 8
}

VANTAGE_INLINE double LaplaceRelaxation::sweep() {
  double largest = 0.0;
  for (const Row& row : rows_) {
    double& value = values_[static_cast<std::size_t>(row.self)];
    const double previous = std::abs(value);
    const double step = mean_of(row) - value;
    value += step;
    if (std::abs(step) > largest * previous) {
      largest = std::abs(step) / previous;  // eq. 10; infinite for the first change of a zero value
    }
  }
  ++report_.sweeps;
  report_.cell_updates += rows_.size();
  report_.last_change = largest;
  return largest;
}

VANTAGE_INLINE void LaplaceRelaxation::run() {
  report_.stop = LaplaceStop::SweepLimit;
  while (report_.sweeps < options_.max_sweeps) {
    if (sweep() < options_.tolerance) {
      report_.stop = LaplaceStop::Converged;
      break;
    }
  }
}

VANTAGE_INLINE void LaplaceRelaxation::run(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    sweep();
  }
}

VANTAGE_INLINE LaplaceSolution relax_laplace(const LaplaceProblem& problem, const RelaxationOptions& options) {
  LaplaceRelaxation relaxation(problem, options);
  relaxation.run();
  return {{relaxation.phi().begin(), relaxation.phi().end()}, relaxation.report()};
}

}  // namespace vantage
