// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>

namespace vantage::detail {
struct CellValues;
}

namespace VANTAGE_EXPORT vantage {

/// A solution of a Laplace problem: a value for every cell of its domain, stored in the bricks of the domain. Copies
/// share the values.
class Potential {
 public:
  /// An empty domain.
  Potential() = default;
  /// The value 1 in every cell: the solution for a domain without sinks.
  Potential(LaplaceDomain domain, const VoxelIndex& source) : domain_(std::move(domain)), source_(source) {}
  /// For solvers: takes the solution, stored in the bricks of `domain`, 0 in cells that are not unknowns.
  Potential(LaplaceDomain domain, const VoxelIndex& source, detail::CellValues&& values);
  /// The values `phi`, by position in the problem. Throws std::invalid_argument unless there is one per cell.
  Potential(const LaplaceProblem& problem, std::span<const double> phi);

  /// The cells and the sinks.
  [[nodiscard]] const LaplaceDomain& domain() const { return domain_; }
  /// The cell of the sensor.
  [[nodiscard]] const VoxelIndex& source() const { return source_; }
  /// The value of a cell: 1 at the source, 0 at sinks; nullopt outside the domain.
  [[nodiscard]] std::optional<double> at(const VoxelIndex& cell) const;

 private:
  LaplaceDomain domain_;
  VoxelIndex source_;
  std::shared_ptr<const detail::CellValues> values_;  // null: 1 everywhere
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/potential.ipp>
#endif
