// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vantage/robot/reachable_space.hpp>

namespace vantage {
namespace {

// Nearest first; among equals the lowest address, so that the choice never depends on anything else.
std::optional<VoxelIndex> nearest_admitted(const OccupancyMap& map, const Platform& platform, const Pose& current,
                                           const VoxelGrid<std::uint8_t>& admitted) {
  const VoxelFrame& frame = map.frame();
  const VoxelIndex home = frame.cell_of(current.translation());
  std::vector<VoxelIndex> candidates;
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(2), [&](const VoxelIndex& cell) {
    if (admitted.value_or(cell, 0) != 0) {
      candidates.push_back(cell);
    }
  });
  const auto distance_m = [&](const VoxelIndex& cell) {
    return cell == home ? -1.0 : (frame.centre_of(cell) - current.translation()).norm();
  };
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const VoxelIndex& a, const VoxelIndex& b) { return distance_m(a) < distance_m(b); });
  for (const VoxelIndex& cell : candidates) {
    Pose there = current;
    there.translation() = frame.centre_of(cell);
    if (platform.admits_motion(map, current, there)) {
      return cell;
    }
  }
  return std::nullopt;
}

}  // namespace

ReachableSpace::ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current) {
  const VoxelBox bounds = map.bounds();
  if (bounds.empty() || !map.frame().addressable(current.translation())) {
    return;
  }
  const VoxelGrid<std::uint8_t> admitted = platform.admitted_cells(map, bounds);
  start_ = nearest_admitted(map, platform, current, admitted);
  if (!start_) {
    return;
  }
  number_ = VoxelGrid<std::uint32_t>(bounds, kOutside);
  std::vector<std::uint32_t>& numbers = number_.values();
  const auto reach = [&](const VoxelIndex& cell, std::size_t offset) {
    numbers[offset] = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(cell);
  };
  reach(*start_, number_.offset_of(*start_));
  for (std::size_t next = 0; next < cells_.size(); ++next) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex neighbour = cells_[next] + step;
      if (bounds.contains(neighbour)) {
        const std::size_t offset = number_.offset_of(neighbour);
        if (admitted.values()[offset] != 0 && numbers[offset] == kOutside) {
          reach(neighbour, offset);
        }
      }
    }
  }
}

}  // namespace vantage
