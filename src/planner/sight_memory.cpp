// SPDX-License-Identifier: MIT
#include "planner/sight_memory.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "geometry/spread_directions.hpp"

namespace vantage::detail {
namespace {

// Room to grow, so that not every scan that adds to the edge of the map makes everything begin anew.
VoxelBox with_room(const OccupancyMap& map) {
  constexpr std::int32_t kRoom = 16;
  VoxelBox cells = map.bounds().grown(kRoom);
  if (const std::optional<VoxelBox>& region = map.region()) {
    cells.lo = {std::max(cells.lo.x, region->lo.x), std::max(cells.lo.y, region->lo.y),
                std::max(cells.lo.z, region->lo.z)};
    cells.hi = {std::min(cells.hi.x, region->hi.x), std::min(cells.hi.y, region->hi.y),
                std::min(cells.hi.z, region->hi.z)};
  }
  return cells;
}

bool holds(const VoxelBox& outer, const VoxelBox& inner) {
  return outer.contains(inner.lo) && outer.contains(inner.hi - VoxelIndex{1, 1, 1});
}

}  // namespace

void SightMemory::follow(const OccupancyMap& map, const ReachableSpace& reachable, double furthest_m,
                         std::size_t direction_count) {
  if (cell_size_m_ != map.resolution_m() || furthest_m_ != furthest_m || direction_count_ != direction_count) {
    begin(map, furthest_m, direction_count);
  }
  if (!holds(cells_, map.bounds())) {
    make_room(map);
  }
  asked_ = nullptr;
  ++survey_;
  VoxelGrid<std::uint64_t> clear(blocks_.box());
  map.for_each_clear([&](const VoxelIndex& cell) { clear[block_of(cell)] |= bit_of(cell); });
  VoxelGrid<std::uint64_t> places(blocks_.box());
  for (const VoxelIndex& cell : reachable.cells()) {
    places[block_of(cell)] |= bit_of(cell);
  }
  for (std::size_t offset = 0; offset < blocks_.size(); ++offset) {
    Block& block = blocks_.values()[offset];
    const std::uint64_t clear_before = std::exchange(block.clear, clear.values()[offset]);
    const std::uint64_t places_before = std::exchange(block.reachable, places.values()[offset]);
    if (clear_before != block.clear || places_before != block.reachable) {
      block.changed = survey_;
    }
  }
  places_.emplace(cells_, reachable.cells());
}

void SightMemory::begin(const OccupancyMap& map, double furthest_m, std::size_t direction_count) {
  answers_.clear();
  cell_size_m_ = 0.0;  // begins again if what follows throws
  tree_.emplace(map.frame(), spread_directions(direction_count), furthest_m);
  cell_size_m_ = map.resolution_m();
  furthest_m_ = furthest_m;
  direction_count_ = direction_count;
}

void SightMemory::make_room(const OccupancyMap& map) {
  answers_.clear();
  cells_ = {};  // makes room again if what follows throws
  const VoxelBox cells = with_room(map);
  const VoxelBox blocks{block_of(cells.lo), block_of(cells.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}};
  blocks_ = VoxelGrid<Block>(blocks);
  cells_ = cells;
}

bool SightMemory::stands(const Answer& answer) const {
  return answer.may_stand &&
         std::all_of(answer.looked_at.begin(), answer.looked_at.end(),
                     [&](std::uint32_t block) { return blocks_.values()[block].changed <= answer.found; }) &&
         std::none_of(answer.without_places.begin(), answer.without_places.end(),
                      [&](const VoxelBox& cells) { return places_->may_hold(cells); });
}

void SightMemory::forget_others() {
  std::erase_if(answers_, [&](const auto& entry) { return entry.second.asked != survey_; });
}

}  // namespace vantage::detail
