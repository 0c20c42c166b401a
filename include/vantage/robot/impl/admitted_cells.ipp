// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/robot/admitted_cells.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage {
namespace detail {

inline constexpr std::int32_t kTileBricks = 8;  // edge of the tiles in which cells are tested, bricks

// Joins boxes that share a whole face.
inline std::vector<VoxelBox> joined_at_faces(std::vector<VoxelBox> boxes) {
  for (std::int32_t VoxelIndex::*const axis : {&VoxelIndex::x, &VoxelIndex::y, &VoxelIndex::z}) {
    const auto across = [axis](VoxelBox box) {
      box.lo.*axis = box.hi.*axis = 0;
      return std::pair(box.lo, box.hi);
    };
    std::sort(boxes.begin(), boxes.end(), [&](const VoxelBox& a, const VoxelBox& b) {
      return std::pair(across(a), a.lo.*axis) < std::pair(across(b), b.lo.*axis);
    });
    std::vector<VoxelBox> joined;
    for (const VoxelBox& box : boxes) {
      if (!joined.empty() && across(joined.back()) == across(box) && joined.back().hi.*axis == box.lo.*axis) {
        joined.back().hi = box.hi;
      } else {
        joined.push_back(box);
      }
    }
    boxes = std::move(joined);
  }
  return boxes;
}

// Boxes of bricks whose cells must be tested again, at most one per tile.
class StaleBoxes {
 public:
  void add(const VoxelBox& bricks) {
    const auto tile = [](std::int32_t brick) { return brick >> 3; };
    for_each_cell({{tile(bricks.lo.x), tile(bricks.lo.y), tile(bricks.lo.z)},
                   {tile(bricks.hi.x - 1) + 1, tile(bricks.hi.y - 1) + 1, tile(bricks.hi.z - 1) + 1}},
                  [&](const VoxelIndex& address) {
                    const VoxelIndex lo{address.x * kTileBricks, address.y * kTileBricks, address.z * kTileBricks};
                    const VoxelBox inside =
                        detail::box_overlap(bricks, {lo, lo + VoxelIndex{kTileBricks, kTileBricks, kTileBricks}});
                    const std::size_t number = numbers_.place(address, boxes_.size());
                    if (number == boxes_.size()) {
                      boxes_.push_back(inside);
                    } else {
                      boxes_[number] = detail::box_around(boxes_[number], inside);
                    }
                  });
  }
  // The boxes around the bricks that `map` stores, joined where they share a face, or their bounding box if that is
  // at most half as large again.
  [[nodiscard]] std::vector<VoxelBox> boxes(const OccupancyMap& map) const {
    std::vector<VoxelBox> stored;
    VoxelBox all;
    double sum = 0.0;
    for (const VoxelBox& box : boxes_) {
      VoxelBox inside;
      for_each_cell(box, [&](const VoxelIndex& brick) {
        if (!inside.contains(brick) && map.find_brick(brick) != nullptr) {
          inside = box_around(inside, {brick, brick + VoxelIndex{1, 1, 1}});
        }
      });
      if (!inside.empty()) {
        stored.push_back(inside);
        all = box_around(all, inside);
        sum += static_cast<double>(inside.size());
      }
    }
    const VoxelIndex extent = all.extent();
    const bool dense = 1.0 * extent.x * extent.y * extent.z <= 1.5 * sum;
    return dense && !all.empty() ? std::vector<VoxelBox>{all} : joined_at_faces(std::move(stored));
  }

 private:
  VoxelTable<std::size_t> numbers_;  // index of the box of each tile
  std::vector<VoxelBox> boxes_;
};

}  // namespace detail

VANTAGE_INLINE void AdmittedCells::follow(const OccupancyMap& map, const Platform& platform) {
  changed_.clear();
  started_anew_ = !map_.is(map) || platform_ != &platform;
  if (started_anew_) {
    *this = AdmittedCells();
  }
  map_ = KnownMap();  // starts anew if the platform throws

  // If the body is larger than a tile, or its size is unknown, all cells are tested again.
  const std::int32_t reach = map.frame().cells_up_to(platform.reach_m()) / Brick::kSide + 1;
  const bool from_anywhere = reach > detail::kTileBricks;
  detail::StaleBoxes stale;
  bool changed = false;
  map.for_each_written_since(followed_, [&](const VoxelIndex& address, const Brick& brick) {
    if (clear_.assign(address, map.clear_plane(brick))) {
      changed = true;
      if (!from_anywhere) {
        stale.add(VoxelBox{address, address + VoxelIndex{1, 1, 1}}.grown(reach));
      }
    }
  });
  if (from_anywhere && changed) {
    map.for_each_brick([&](const VoxelIndex& address, const Brick& /*brick*/) {
      stale.add({address, address + VoxelIndex{1, 1, 1}});
    });
  }
  for (const VoxelBox& bricks : stale.boxes(map)) {
    ask(map, platform, bricks);
  }
  map_ = KnownMap(map);
  platform_ = &platform;
  followed_ = map.revision();
}

VANTAGE_INLINE void AdmittedCells::ask(const OccupancyMap& map, const Platform& platform, const VoxelBox& bricks) {
  constexpr std::size_t kMostBricks = 32768;  // the platform answers with a byte for every cell: 16 MiB
  if (bricks.size() > kMostBricks && bricks.extent().z > detail::kTileBricks) {
    for (VoxelBox slab = bricks; slab.lo.z < bricks.hi.z; slab.lo.z = slab.hi.z) {
      slab.hi.z = std::min(slab.lo.z + detail::kTileBricks, bricks.hi.z);
      ask(map, platform, slab);
    }
    return;
  }
  const VoxelGrid<std::uint8_t> admitted = platform.admitted_cells(map, Brick::cells_of(bricks));
  for_each_cell(bricks, [&](const VoxelIndex& address) {
    if (map.find_brick(address) == nullptr) {
      return;
    }
    BrickPlane plane{};
    const VoxelIndex first = Brick::first_cell(address);
    for (std::int32_t z = 0; z < Brick::kSide; ++z) {
      for (std::int32_t y = 0; y < Brick::kSide; ++y) {
        const std::uint8_t* const row = &admitted.values()[admitted.offset_of(first + VoxelIndex{0, y, z})];
        if (std::all_of(row, row + Brick::kSide, [](std::uint8_t cell) { return cell == 0; })) {
          continue;
        }
        for (std::int32_t x = 0; x < Brick::kSide; ++x) {
          const std::size_t offset = Brick::offset_of({x, y, z});
          plane[offset >> 6U] |= std::uint64_t{row[x] != 0} << (offset & 63U);
        }
      }
    }
    if (cells_.assign(address, plane)) {
      changed_.push_back(address);
    }
  });
}

}  // namespace vantage
