// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/map/scan.hpp>

namespace vantage::detail {

/// The rays of a scan in the world frame. Blocks are recomputed on each request, which is cheaper than storing them.
class ScanRays {
 public:
  /// Classifies and counts the rays. Throws std::invalid_argument if the pose is not rigid or the range is not
  /// positive. The points of the scan must outlive this object.
  ScanRays(const ScanView& scan, const VoxelFrame& frame);

  /// The common start of all rays.
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  /// Ray counts; the cell counts are not set yet.
  [[nodiscard]] const ScanReport& report() const { return report_; }
  /// Whether no ray is usable.
  [[nodiscard]] bool empty() const { return report_.hits + report_.beyond_range + report_.no_return == 0; }
  /// Bounding box of the cells of the origin and of all ends; empty if no ray is usable.
  [[nodiscard]] const VoxelBox& cells() const { return cells_; }

  /// The number of blocks of all rays.
  [[nodiscard]] std::size_t blocks() const { return point_blocks_ + blocks_of_directions(); }
  /// Whether the first `blocks_of_points(1)` blocks are tiles of 8 x 8 pixels of a depth image.
  [[nodiscard]] bool are_tiles() const { return scan_.organised(); }
  /// The number of blocks of returns. With a stride, only every stride-th row and column of the depth image is used.
  [[nodiscard]] std::size_t blocks_of_points(std::size_t stride) const;
  /// Computes one block. Blocks of returns come first; with a stride above 1 there are no others.
  void block(std::size_t number, std::size_t stride, RayBlock& block) const {
    place(number, stride, block);
    placer_.place_cells(block);
  }

 private:
  static constexpr std::size_t kTileSide = 8;

  [[nodiscard]] std::size_t blocks_of_directions() const {
    return (scan_.no_return.size() + RayBlock::kRays - 1) / RayBlock::kRays;
  }
  void place(std::size_t number, std::size_t stride, RayBlock& block) const;
  void gather_tile(std::size_t number, std::size_t stride, RayBlock& block) const;
  void count(const RayBlock& block);

  ScanView scan_;
  Eigen::Vector3d origin_;
  RayPlacer placer_;
  std::size_t point_blocks_;
  ScanReport report_;
  VoxelBox cells_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/scan_rays.ipp>
#endif
