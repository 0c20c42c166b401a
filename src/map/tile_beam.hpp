// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <map/ray_block.hpp>
#include <map/scan_marks.hpp>

namespace vantage {

/// What of a block of rays may still pass cells without a mark: of the rays whose bits are set in `rays`, what comes
/// after `faces_before` faces across `axis`.
struct UndrawnPart {
  std::uint64_t rays = 0;
  std::size_t axis = 0;
  std::int64_t faces_before = 0;
};

/// Follows the rays of a block whose bits are set in `usable`, at least one, slice by slice of cells while all the
/// cells between them have marks. Of rays that diverge much, everything is called undrawn. `block` keeps its usable
/// rays.
[[nodiscard]] UndrawnPart undrawn_part(RayBlock& block, std::uint64_t usable, const Eigen::Vector3d& origin,
                                       const VoxelFrame& frame, const ScanMarks& marks);

}  // namespace vantage
