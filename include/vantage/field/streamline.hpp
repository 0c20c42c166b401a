// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The neighbour with the lowest phi, if that is strictly lower than phi at `from`; among equals, the first in the
/// order of kFaceNeighbours. nullopt if there is none. Here and below, `phi` is indexed by position in the problem.
[[nodiscard]] std::optional<LaplaceProblem::Position> steepest_neighbour(const LaplaceProblem& problem,
                                                                         std::span<const double> phi,
                                                                         LaplaceProblem::Position from);

/// The number of cells, sinks excluded, without a strictly lower neighbour. If it is 0, the field is certified:
/// steepest descent from every cell ends at a sink. A small solver tolerance does not guarantee this, because phi is
/// nearly constant in dead ends.
[[nodiscard]] std::size_t count_stuck_cells(const LaplaceProblem& problem, std::span<const double> phi);

/// A path of steepest descent from cell to cell. Phi decreases strictly along it, so it always ends.
struct Descent {
  std::vector<LaplaceProblem::Position> cells;  ///< the visited cells, the start first
  bool reaches_sink = false;  ///< whether it ends at a sink; otherwise its last cell has no lower neighbour
};
[[nodiscard]] Descent descend(const LaplaceProblem& problem, std::span<const double> phi,
                              LaplaceProblem::Position from);

/// A smooth path of steepest descent from `from_m` (world frame, metres) to a sink: a curve along the negative
/// gradient in steps of half a cell. The gradient is taken by central differences at the cell centres and
/// interpolated linearly. Every point lies in a cell of the problem, and the last in a sink. nullopt if the curve
/// leaves the cells or gets stuck, which can happen in a discrete field; then use descend(), which always works on a
/// certified field. `from_m` must lie in a cell of the problem. (Shade & Newman 2011, IV-D.)
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> streamline(const LaplaceProblem& problem,
                                                                     std::span<const double> phi,
                                                                     const VoxelFrame& frame,
                                                                     const Eigen::Vector3d& from_m);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/streamline.ipp>
#endif
