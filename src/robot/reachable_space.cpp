// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vantage/robot/reachable_space.hpp>

#include "geometry/box_around.hpp"

namespace vantage {
namespace {

// Nearest first; among equals the lowest address, so that the choice never depends on anything else.
std::optional<VoxelIndex> nearest_admitted(const OccupancyMap& map, const Platform& platform, const Pose& current,
                                           const VoxelGrid<std::uint8_t>& admitted) {
  const VoxelFrame& frame = map.frame();
  const VoxelIndex home = frame.cell_of(current.translation());
  std::vector<VoxelIndex> candidates;
  // A body that is pushed against a wall gets away by half of itself, and one cell more.
  constexpr double kMostCells = 16.0;
  const double half_m = 0.5 * platform.body_box(current).extent().maxCoeff();
  const auto near = static_cast<std::int32_t>(std::clamp(std::ceil(half_m / frame.size_m) + 1.0, 2.0, kMostCells));
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(near), [&](const VoxelIndex& cell) {
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

// An admitted cell that the flood has not reached.
constexpr std::uint32_t kUnnumbered = ReachableSpace::kOutside - 1;

// What is admitted, with a layer around it that is not, so that every neighbour of an admitted cell has its place.
VoxelGrid<std::uint32_t> unnumbered(const VoxelGrid<std::uint8_t>& admitted) {
  const VoxelBox& box = admitted.box();
  VoxelGrid<std::uint32_t> number(box.grown(1), ReachableSpace::kOutside);
  const auto row = static_cast<std::size_t>(box.extent().x);
  for (std::size_t from = 0; from < admitted.size(); from += row) {
    const std::size_t to = number.offset_of(admitted.cell_at(from));
    for (std::size_t x = 0; x < row; ++x) {
      number.values()[to + x] = admitted.values()[from + x] != 0 ? kUnnumbered : ReachableSpace::kOutside;
    }
  }
  return number;
}

}  // namespace

ReachableSpace::ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current) {
  frame_ = map.frame();
  const VoxelBox bounds = map.bounds();
  if (bounds.empty() || !map.frame().addressable(current.translation())) {
    return;
  }
  const VoxelGrid<std::uint8_t> admitted = platform.admitted_cells(map, bounds);
  start_ = nearest_admitted(map, platform, current, admitted);
  if (!start_ && platform.admits(map, current)) {
    start_ = map.frame().cell_of(current.translation());
    stands_at_m_ = current.translation();
    cells_ = {*start_};
    number_ = VoxelGrid<std::uint32_t>(VoxelBox{*start_, *start_ + VoxelIndex{1, 1, 1}}, 0);
    return;
  }
  if (!start_) {
    return;
  }
  number_ = unnumbered(admitted);
  std::vector<std::uint32_t>& numbers = number_.values();
  std::vector<std::size_t> offsets;  // of the cells
  std::array<std::size_t, kFaceNeighbours.size()> strides{};
  std::transform(kFaceNeighbours.begin(), kFaceNeighbours.end(), strides.begin(), [&](const VoxelIndex& step) {
    return number_.offset_of(*start_ + step) - number_.offset_of(*start_);
  });
  const auto reach = [&](const VoxelIndex& cell, std::size_t offset) {
    numbers[offset] = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(cell);
    offsets.push_back(offset);
  };
  reach(*start_, number_.offset_of(*start_));
  for (std::size_t next = 0; next < cells_.size(); ++next) {
    const VoxelIndex cell = cells_[next];
    const std::size_t offset = offsets[next];
    for (std::size_t face = 0; face < kFaceNeighbours.size(); ++face) {
      const std::size_t neighbour = offset + strides[face];  // wraps where the stride is negative
      if (numbers[neighbour] == kUnnumbered) {
        reach(cell + kFaceNeighbours[face], neighbour);
      }
    }
  }
  std::replace(numbers.begin(), numbers.end(), kUnnumbered, kOutside);
}

ReachableSpace::ReachableSpace(const VoxelFrame& frame, std::vector<VoxelIndex> cells)
    : frame_(frame), start_(cells.front()), cells_(std::move(cells)), number_(detail::box_around(cells_), kOutside) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    number_[cells_[i]] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace vantage
