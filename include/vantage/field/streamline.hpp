// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/field/potential.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The neighbour with the lowest potential, if that is strictly lower than the potential at `from`; among equals, the
/// first in the order of kFaceNeighbours. nullopt if there is none.
[[nodiscard]] std::optional<VoxelIndex> steepest_neighbour(const Potential& potential, const VoxelIndex& from);

/// The number of cells, sinks excluded, without a strictly lower neighbour. If it is 0, the field is certified:
/// steepest descent from every cell ends at a sink. A small solver tolerance does not guarantee this, because the
/// potential is nearly constant in dead ends.
[[nodiscard]] std::size_t count_stuck_cells(const Potential& potential);

/// A path of steepest descent from cell to cell. The potential decreases strictly along it, so it always ends.
struct Descent {
  std::vector<VoxelIndex> cells;  ///< the visited cells, the start first
  bool reaches_sink = false;      ///< whether it ends at a sink; otherwise its last cell has no lower neighbour
};
[[nodiscard]] Descent descend(const Potential& potential, const VoxelIndex& from);

/// A smooth path of steepest descent from `from_m` (world frame, metres) to a sink: a curve along the negative
/// gradient in steps of half a cell. The gradient is taken by central differences at the cell centres and
/// interpolated linearly. Every point lies in a cell of the domain, and the last in a sink. nullopt if the curve
/// leaves the cells or gets stuck, which can happen in a discrete field; then use descend(), which always works on a
/// certified field. `from_m` must lie in a cell of the domain. (Shade & Newman 2011, IV-D.)
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> streamline(const Potential& potential,
                                                                     const VoxelFrame& frame,
                                                                     const Eigen::Vector3d& from_m);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/streamline.ipp>
#endif
