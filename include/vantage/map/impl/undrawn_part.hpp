// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/map/impl/scan_marks.hpp>

namespace vantage::detail {

/// The part of a block of rays that may still pass unmarked cells: the rays selected by `rays`, each from its
/// `faces_before`-th face across `axis` on.
struct UndrawnPart {
  std::uint64_t rays = 0;
  std::size_t axis = 0;
  std::int64_t faces_before = 0;
};

/// Follows the `usable` rays of a block (at least one) as one beam, slice by slice, while all cells between them have
/// marks. If the rays diverge too much, the result is all of them in full.
[[nodiscard]] UndrawnPart undrawn_part(const RayBlock& block, std::uint64_t usable, const Eigen::Vector3d& origin,
                                       const VoxelFrame& frame, const ScanMarks& marks);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/undrawn_part.ipp>
#endif
