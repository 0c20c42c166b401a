// SPDX-License-Identifier: MIT
#include "arm/clear_space.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <vantage/robot/impl/swept_sphere.hpp>

namespace vantage::detail {
namespace {

constexpr int kMostRings = 6;

// Erosion along one axis: keeps the cells whose two neighbours are set. `step` is the stride between neighbours, and
// `length` their number along the axis. Cells at both ends are cleared.
void wear_down(const std::vector<std::uint8_t>& cells, std::size_t step, std::size_t length,
               std::vector<std::uint8_t>& left) {
  const std::size_t slab = step * length;
  for (std::size_t first = 0; first < cells.size(); first += slab) {
    const std::uint8_t* from = cells.data() + first;
    std::uint8_t* to = left.data() + first;
    std::fill(to, to + step, std::uint8_t{0});
    for (std::size_t i = step; i + step < slab; ++i) {
      to[i] = from[i - step] & from[i] & from[i + step];
    }
    std::fill(to + slab - step, to + slab, std::uint8_t{0});
  }
}

}  // namespace

ClearSpace::ClearSpace(const VoxelFrame& frame, VoxelGrid<std::uint8_t> clear)
    : frame_(frame), rings_(std::move(clear)) {
  const VoxelIndex extent = rings_.box().extent();
  const auto row = static_cast<std::size_t>(extent.x);
  const auto plane = row * static_cast<std::size_t>(extent.y);
  std::vector<std::uint8_t>& rings = rings_.values();
  std::transform(rings.begin(), rings.end(), rings.begin(), [](std::uint8_t value) { return value != 0 ? 1 : 0; });
  std::vector<std::uint8_t> left = rings;
  std::vector<std::uint8_t> worn(rings.size());
  for (int ring = 1; ring < kMostRings; ++ring) {
    wear_down(left, 1, row, worn);
    wear_down(worn, row, static_cast<std::size_t>(extent.y), left);
    wear_down(left, plane, static_cast<std::size_t>(extent.z), worn);
    std::swap(left, worn);
    std::transform(rings.begin(), rings.end(), left.begin(), rings.begin(),
                   [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a + b); });
  }
}

// If a cell has n rings, all cells closer than n - 1 cells to any point in it are clear.
ClearSpace::Walk ClearSpace::walk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double touching_m) const {
  const double length_m = (to - from).norm();
  const double least_step_m = 0.25 * frame_.size_m;
  Walk walk;
  for (double way_m = 0.0;;) {
    const double share = length_m > 0.0 ? way_m / length_m : 0.0;
    const VoxelIndex cell = frame_.cell_of(share < 1.0 ? Eigen::Vector3d(from + share * (to - from)) : to);
    const int rings = rings_.value_or(cell, 0);
    if (rings == 0) {
      walk.obstacle = cell;
      return walk;
    }
    // free distance along the segment in both directions
    const double settled_m = (rings - 1) * frame_.size_m * (1.0 - 1e-9) - touching_m;
    walk.far_from_any = walk.far_from_any && settled_m >= std::min(least_step_m, length_m);
    if (way_m >= length_m) {
      return walk;
    }
    way_m = std::min(length_m, way_m + (walk.far_from_any ? settled_m : frame_.size_m));
  }
}

std::optional<VoxelIndex> ClearSpace::obstacle(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                               double radius_m) const {
  const Walk walked = walk(from, to, touching_distance_m(frame_, radius_m));
  if (walked.obstacle || walked.far_from_any) {
    return walked.obstacle;
  }
  // The sweep stops at the first cell that is not clear, which is the last one stored here.
  VoxelIndex last{};
  const bool clear = swept_sphere_is_clear(frame_, from, to, radius_m, [&](const VoxelIndex& cell) {
    const bool is_clear = this->is_clear(cell);
    last = is_clear ? last : cell;
    return is_clear;
  });
  return clear ? std::nullopt : std::optional(last);
}

}  // namespace vantage::detail
