// SPDX-License-Identifier: MIT
#include "planner/sight_memory.hpp"

#include <algorithm>
#include <bit>

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
  CellRows clear(cells_);
  map.for_each_clear([&](const VoxelIndex& cell) { clear.insert(cell); });
  mark_changes(clear_, clear);
  clear_ = std::move(clear);
  CellRows places(cells_);
  for (const VoxelIndex& cell : reachable.cells()) {
    places.insert(cell);
  }
  mark_changes(reachable_, places);
  reachable_ = std::move(places);
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
  clear_ = CellRows(cells);
  reachable_ = CellRows(cells);
  changed_ = VoxelGrid<std::uint32_t>(blocks);
  looked_at_ = VoxelGrid<std::uint32_t>(blocks);
  cells_ = cells;
}

void SightMemory::mark_changes(const CellRows& before, const CellRows& now) {
  for (std::int32_t z = cells_.lo.z; z < cells_.hi.z; ++z) {
    for (std::int32_t y = cells_.lo.y; y < cells_.hi.y; ++y) {
      const auto old_row = before.row(y, z);
      const auto new_row = now.row(y, z);
      for (std::size_t word = 0; word < new_row.size(); ++word) {
        for (std::uint64_t left = old_row[word] ^ new_row[word]; left != 0; left &= left - 1) {
          const auto steps = static_cast<std::int32_t>(word * 64) + std::countr_zero(left);
          changed_[block_of({cells_.lo.x + steps, y, z})] = survey_;
        }
      }
    }
  }
}

bool SightMemory::stands(const Answer& answer) const {
  return answer.may_stand &&
         std::all_of(answer.looked_at.begin(), answer.looked_at.end(),
                     [&](std::uint32_t block) { return changed_.values()[block] <= answer.found; }) &&
         std::none_of(answer.without_places.begin(), answer.without_places.end(),
                      [&](const VoxelBox& cells) { return places_->may_hold(cells); });
}

void SightMemory::forget_others() {
  std::erase_if(answers_, [&](const auto& entry) { return entry.second.asked != survey_; });
}

}  // namespace vantage::detail
