// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/view/impl/sight_memory.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/spread_directions.hpp>

namespace vantage::detail {

// The cells of a brick that do not rest.
inline BrickPlane without_resting(BrickPlane cells, const VoxelIndex& brick, const TriedViews& tried) {
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    for_each_offset(cells[word], word, [&](std::size_t offset) {
      const bool rests = tried.rests(Brick::cell_at(brick, offset));
      cells[word] &= ~(std::uint64_t{rests} << (offset & 63U));
    });
  }
  return cells;
}

VANTAGE_INLINE void SightMemory::follow(const OccupancyMap& map, const ReachableSpace& reachable,
                                        const TriedViews& tried, double furthest_m, std::size_t direction_count) {
  const bool is_level = map.region() && map.region()->extent().z == 1;
  if (cell_size_m_ != map.resolution_m() || furthest_m_ != furthest_m || direction_count_ != direction_count ||
      is_level_ != is_level) {
    is_level_ = is_level;
    begin(map, furthest_m, direction_count);
    all_changed_ = true;
  } else {
    all_changed_ = !map_.is(map);
  }
  asked_ = nullptr;
  last_ = {};
  visited_.assign(kRemembered, {});
  asked_boxes_.assign(kRemembered, {});
  ++survey_;
  touched_ = {};
  follow_free(map);
  follow_places(reachable, tried);
  if (!touched_.empty()) {
    constexpr std::int32_t kBeside = 3;  // a cell beside the one asked for, and what lies beside that
    touched_ = touched_.grown(map.frame().cells_up_to(furthest_m_) + kBeside);
  }
}

VANTAGE_INLINE void SightMemory::begin(const OccupancyMap& map, double furthest_m, std::size_t direction_count) {
  answers_.clear();
  kept_answers_ = 0;
  numbers_.clear();
  cell_size_m_ = 0.0;  // starts again if the next lines throw
  tree_.emplace(map.frame(), is_level_ ? level_directions(direction_count) : spread_directions(direction_count),
                furthest_m, may_face_);
  cell_size_m_ = map.resolution_m();
  furthest_m_ = furthest_m;
  direction_count_ = direction_count;
}

VANTAGE_INLINE void SightMemory::follow_free(const OccupancyMap& map) {
  if (!map_.is(map)) {
    followed_ = 0;
    for (const BrickBlocks& stored : bricks_) {
      if (map.find_brick(stored.brick) == nullptr) {
        set(stored.brick, {}, &Block::free);
      }
    }
    map_ = KnownMap(map);
  }
  map.for_each_written_since(followed_, [&](const VoxelIndex& address, const Brick& brick) {
    set(address, brick.free(), &Block::free);
    touch(address);
  });
  followed_ = map.revision();
}

VANTAGE_INLINE void SightMemory::follow_places(const ReachableSpace& reachable, const TriedViews& tried) {
  if (reachable.started_anew()) {
    for (BrickBlocks& stored : bricks_) {
      for (Block& block : stored.blocks) {
        if (std::exchange(block.reachable, 0) != 0) {
          block.changed = survey_;
          touch(stored.brick);
        }
      }
    }
    places_.clear();
  }
  const std::vector<VoxelBox> resting = tried.resting();
  const auto update = [&](const VoxelIndex& brick) {
    const BrickPlane* const cells = reachable.find(brick);
    const bool any_rest = std::any_of(resting.begin(), resting.end(),
                                      [&](const VoxelBox& box) { return Brick::over(box).contains(brick); });
    const BrickPlane places = cells == nullptr ? BrickPlane{} : *cells;
    set(brick, any_rest ? without_resting(places, brick, tried) : places, &Block::reachable);
    touch(brick);
  };
  for (const VoxelIndex& brick : reachable.changed()) {
    update(brick);
    *reachable.find(brick) == BrickPlane{} ? places_.erase(brick) : places_.insert(brick);
  }
  if (resting_ != resting) {
    std::vector<VoxelBox> changed;
    std::set_symmetric_difference(resting_.begin(), resting_.end(), resting.begin(), resting.end(),
                                  std::back_inserter(changed),
                                  [](const VoxelBox& a, const VoxelBox& b) { return RasterOrder{}(a.lo, b.lo); });
    for (const VoxelBox& box : changed) {
      for_each_cell(Brick::over(box), update);
    }
    resting_ = resting;
  }
}

VANTAGE_INLINE void SightMemory::turn_to(const VoxelIndex& brick) {
  Visited& visited = visited_[std::hash<VoxelIndex>{}(brick) % kRemembered];
  if (visited.brick != brick) {
    const BrickDirectory::Number number = store(brick);
    visited = {brick, number, &bricks_[number]};
  }
  last_ = visited;
}

VANTAGE_INLINE bool SightMemory::may_hold_places(const VoxelBox& cells) {
  const VoxelBox bricks = Brick::over(cells);
  const std::hash<VoxelIndex> hash;
  Asked& asked = asked_boxes_[(hash(bricks.lo) + 7 * hash(bricks.hi)) % kRemembered];
  if (asked.bricks != bricks) {
    asked = {bricks, places_.touches(cells)};
  }
  return asked.may_hold;
}

VANTAGE_INLINE BrickDirectory::Number SightMemory::store(const VoxelIndex& brick) {
  BrickDirectory::Number& number = directory_.place(brick);
  if (number == BrickDirectory::kNone) {
    number = static_cast<BrickDirectory::Number>(bricks_.size());
    bricks_.push_back({.brick = brick});
  }
  return number;
}

// Sets the blocks of a brick. Those that are not stored have no cells.
template <class Member>
void SightMemory::set(const VoxelIndex& brick, const BrickPlane& cells, Member member) {
  if (cells == BrickPlane{} && directory_.find(brick) == BrickDirectory::kNone) {
    return;
  }
  BrickBlocks& stored = bricks_[store(brick)];
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    Block& block = stored.blocks[word];
    if (std::exchange(block.*member, cells[word]) != cells[word]) {
      block.changed = survey_;
    }
  }
}

VANTAGE_INLINE void SightMemory::touch(const VoxelIndex& brick) {
  touched_ = box_around(touched_, Brick::cells_of(brick));
}

VANTAGE_INLINE bool SightMemory::stands(const Answer& answer) const {
  return answer.may_stand &&
         std::all_of(answer.looked_at.begin(), answer.looked_at.end(),
                     [&](std::uint32_t at) {
                       return bricks_[at / Brick::kWords].blocks[at % Brick::kWords].changed <= answer.found;
                     }) &&
         std::none_of(answer.without_places.begin(), answer.without_places.end(),
                      [&](const VoxelBox& cells) { return places_.touches(cells); });
}

VANTAGE_INLINE SightMemory::Answer& SightMemory::answer_of(const VoxelIndex& cell) {
  const auto next = static_cast<std::uint32_t>(answers_.size());
  const std::uint32_t number = numbers_.place(cell, next);
  if (number == next) {
    answers_.push_back({.cell = cell});
  }
  return answers_[number];
}

VANTAGE_INLINE void SightMemory::forget_others() {
  if (answers_.size() <= 2 * kept_answers_) {
    return;
  }
  if (std::erase_if(answers_,
                    [&](const Answer& answer) { return answer.asked != survey_ && may_differ(answer.cell); }) > 0) {
    numbers_.clear();
    for (const Answer& answer : answers_) {
      numbers_.place(answer.cell, static_cast<std::uint32_t>(&answer - answers_.data()));
    }
  }
  kept_answers_ = answers_.size();
}

}  // namespace vantage::detail
