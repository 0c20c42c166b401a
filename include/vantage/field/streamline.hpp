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

/// The open neighbour that lies lowest, if it lies strictly lower than the cell itself; the first in the order of
/// kFaceNeighbours among equals. `phi` is by position in the problem, here and below.
[[nodiscard]] std::optional<LaplaceProblem::Position> steepest_neighbour(const LaplaceProblem& problem,
                                                                         std::span<const double> phi,
                                                                         LaplaceProblem::Position from);

/// Cells other than sinks that have no strictly lower neighbour. A field with none is certified: steepest descent
/// from every cell ends at a sink. A small tolerance does not give that, for phi is level in dead ends.
[[nodiscard]] std::size_t count_stuck_cells(const LaplaceProblem& problem, std::span<const double> phi);

/// Steepest descent from cell to cell. Phi falls strictly along it, so it always ends.
struct Descent {
  std::vector<LaplaceProblem::Position> cells;  ///< the start first
  bool reaches_sink = false;                    ///< else it is stuck at the last cell
};
[[nodiscard]] Descent descend(const LaplaceProblem& problem, std::span<const double> phi,
                              LaplaceProblem::Position from);

/// The streamline of steepest descent from `from_m` (Shade & Newman 2011, IV-D): a curve through the negative
/// gradient, differences at the cell centres interpolated linearly between them, in steps of half a cell. Ends in a
/// sink's cell; every point lies in a cell of the problem. None if it leaves them or comes to rest before that, which
/// a discrete field allows: descend() is then the way that is certain. `from_m` must lie in a cell of the problem.
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> streamline(const LaplaceProblem& problem,
                                                                     std::span<const double> phi,
                                                                     const VoxelFrame& frame,
                                                                     const Eigen::Vector3d& from_m);

}  // namespace vantage
