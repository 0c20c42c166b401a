// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <vantage/map/impl/scan_rays.hpp>
#include <vantage/map/impl/validate_scan.hpp>

namespace vantage::detail {

inline std::size_t divided_up(std::size_t count, std::size_t by) { return (count + by - 1) / by; }

// Copies every `stride`-th point from `first` on to the rays of a block, starting at `ray`. Where points lie side by
// side, eight at a time: a copy of constant size needs no call.
inline void put(const PointsView& points, std::size_t first, std::size_t count, std::size_t stride, std::size_t ray,
                RayBlock& block) {
  constexpr std::size_t kTogether = 8;
  const bool side_by_side = stride * points.stride_bytes() == PointsView::kBytes;
  std::size_t i = 0;
  for (; side_by_side && i + kTogether <= count; i += kTogether) {
    std::memcpy(&block.point[3 * (ray + i)], points.at(first + i), kTogether * PointsView::kBytes);
  }
  for (; i < count; ++i) {
    std::memcpy(&block.point[3 * (ray + i)], points.at(first + i * stride), PointsView::kBytes);
  }
}

// Fills unused rays of a block with NaN.
inline void put_none(std::size_t first, std::size_t end, RayBlock& block) {
  std::fill(block.point.begin() + static_cast<std::ptrdiff_t>(3 * first),
            block.point.begin() + static_cast<std::ptrdiff_t>(3 * end), std::numeric_limits<float>::quiet_NaN());
}

// Fills a block with the rays of a list from `first` on.
inline void gather(const PointsView& rays, std::size_t first, RayBlock& block) {
  const std::size_t count = std::min(rays.size() - first, RayBlock::kRays);
  put(rays, first, count, 1, 0, block);
  put_none(count, RayBlock::kRays, block);
}

// Bounding box of the ends of many blocks. It keeps one bound per ray position, so there is no dependency between the
// rays of a block.
class Bounds {
 public:
  explicit Bounds(const Eigen::Vector3d& start) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo_[axis].fill(start[static_cast<Eigen::Index>(axis)]);
      hi_[axis].fill(start[static_cast<Eigen::Index>(axis)]);
    }
  }
  void add(const RayBlock& block) {
    compiled_for(best_instruction_set(), [&] {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
          const double end = block.end[axis][i];
          lo_[axis][i] = end < lo_[axis][i] ? end : lo_[axis][i];
          hi_[axis][i] = end > hi_[axis][i] ? end : hi_[axis][i];
        }
      }
    });
  }
  [[nodiscard]] VoxelBox cells(const VoxelFrame& frame) const {
    Eigen::Vector3d lo;
    Eigen::Vector3d hi;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo[static_cast<Eigen::Index>(axis)] = *std::min_element(lo_[axis].begin(), lo_[axis].end());
      hi[static_cast<Eigen::Index>(axis)] = *std::max_element(hi_[axis].begin(), hi_[axis].end());
    }
    return {frame.cell_of(lo), frame.cell_of(hi) + VoxelIndex{1, 1, 1}};
  }

 private:
  std::array<RayBlock::PerRay<double>, 3> lo_{};
  std::array<RayBlock::PerRay<double>, 3> hi_{};
};

VANTAGE_INLINE ScanRays::ScanRays(const ScanView& scan, const VoxelFrame& frame)
    : scan_((validate(scan), scan)),
      origin_(scan.world_from_sensor.translation()),
      placer_{SensorFrame(scan.world_from_sensor), scan.max_range_m,
              frame.addressable(origin_) ? frame.size_m * kFurthestVoxel : -1.0, frame.size_m},
      point_blocks_(blocks_of_points(1)) {
  RayBlock block;
  Bounds bounds(origin_);
  const std::size_t all = blocks();
  for (std::size_t i = 0; i < all; ++i) {
    place(i, 1, block);
    bounds.add(block);
    count(block);
  }
  // The NaN rays that fill incomplete blocks were counted too.
  report_.not_finite -= all * RayBlock::kRays - scan.points.size() - scan.no_return.size();
  if (!empty()) {
    cells_ = bounds.cells(frame);
  }
}

VANTAGE_INLINE std::size_t ScanRays::blocks_of_points(std::size_t stride) const {
  return are_tiles() ? divided_up(scan_.width, kTileSide * stride) * divided_up(scan_.height, kTileSide * stride)
                     : divided_up(scan_.points.size(), RayBlock::kRays);
}

VANTAGE_INLINE void ScanRays::place(std::size_t number, std::size_t stride, RayBlock& block) const {
  const bool is_of_points = stride > 1 || number < point_blocks_;
  if (!is_of_points) {
    gather(scan_.no_return, (number - point_blocks_) * RayBlock::kRays, block);
  } else if (!are_tiles()) {
    gather(scan_.points, number * RayBlock::kRays, block);
  } else {
    gather_tile(number, stride, block);
  }
  placer_.place_ends(is_of_points, block);
}

VANTAGE_INLINE void ScanRays::gather_tile(std::size_t number, std::size_t stride, RayBlock& block) const {
  const std::size_t tiles_wide = divided_up(scan_.width, kTileSide * stride);
  const std::size_t first_row = number / tiles_wide * kTileSide * stride;
  const std::size_t first_column = number % tiles_wide * kTileSide * stride;
  const std::size_t left_in_row = divided_up(scan_.width - first_column, stride);
  for (std::size_t i = 0; i < kTileSide; ++i) {
    const std::size_t row = first_row + i * stride;
    const std::size_t count = row < scan_.height ? std::min(left_in_row, kTileSide) : 0;
    if (count > 0) {
      put(scan_.points, row * scan_.width + first_column, count, stride, i * kTileSide, block);
    }
    put_none(i * kTileSide + count, (i + 1) * kTileSide, block);
  }
}

VANTAGE_INLINE void ScanRays::count(const RayBlock& block) {
  if (block.all_hit()) {
    report_.hits += RayBlock::kRays;
    return;
  }
  std::array<std::size_t, 6> rays{};
  for (const std::int64_t fate : block.fate) {
    ++rays[static_cast<std::size_t>(fate)];
  }
  report_.hits += rays[0];
  report_.beyond_range += rays[1];
  report_.no_return += rays[2];
  report_.not_finite += rays[3];
  report_.zero_length += rays[4];
  report_.not_addressable += rays[5];
}

}  // namespace vantage::detail
