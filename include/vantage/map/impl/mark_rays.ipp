// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <unordered_set>
#include <vantage/map/impl/mark_rays.hpp>
#include <vantage/map/impl/ray_marker.hpp>
#include <vantage/map/impl/undrawn_part.hpp>

namespace vantage::detail {

// Calls `visit(block)` for all blocks of rays.
template <class Visit>
void for_each_block(const ScanRays& rays, Visit&& visit) {
  RayBlock block;
  for (std::size_t number = 0; number < rays.blocks(); ++number) {
    rays.block(number, 1, block);
    visit(block);
  }
}

// Marks the end cells of the block's returns. Calls `is_first(ray)` for the first return in each cell, and for every
// return whose cell is outside the clip.
template <class IsFirst>
void mark_hits(const RayBlock& block, ScanMarks& marks, IsFirst&& is_first) {
  if (!marks.holds_all()) {
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      const VoxelIndex cell{block.cell[0][i], block.cell[1][i], block.cell[2][i]};
      if (block.hits(i) && (marks.leaves_out(cell) || marks.mark_hit(cell))) {
        is_first(i);
      }
    }
    return;
  }
  RayBlock::PerRay<std::uint64_t> position;
  compiled_for(best_instruction_set(), [&] {
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      position[i] = marks.position_of({block.cell[0][i], block.cell[1][i], block.cell[2][i]});
    }
  });
  std::uint64_t* const hit = marks.hit();
  for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
    const std::uint64_t bit = std::uint64_t{block.hits(i)} << (position[i] & 63U);
    std::uint64_t& word = hit[position[i] >> 6U];
    if ((bit & ~word) != 0) {
      word |= bit;
      is_first(i);
    }
  }
}

// The first return into each cell, moved to the centre of the cell, and all rays without a return.
inline std::vector<DrawnRay> one_ray_per_end_cell(const ScanRays& rays, const VoxelFrame& frame, ScanMarks& marks) {
  std::vector<DrawnRay> drawn;
  std::unordered_set<VoxelIndex> left_out;  // end cells outside the clip
  for_each_block(rays, [&](const RayBlock& block) {
    const auto cell = [&](std::size_t i) { return VoxelIndex{block.cell[0][i], block.cell[1][i], block.cell[2][i]}; };
    mark_hits(block, marks, [&](std::size_t i) {
      if (!marks.leaves_out(cell(i)) || left_out.insert(cell(i)).second) {
        drawn.push_back({frame.centre_of(cell(i)), cell(i)});
      }
    });
    for (std::size_t i = 0; i < RayBlock::kRays && !block.all_hit(); ++i) {
      if (block.usable(i) && !block.hits(i)) {
        drawn.push_back({{block.end[0][i], block.end[1][i], block.end[2][i]}, cell(i)});
      }
    }
  });
  return drawn;
}

// Draws a list of rays. Each lane gets a contiguous part.
inline void draw(const std::vector<DrawnRay>& list, RayMarker& marker) {
  std::array<std::size_t, RayLanes::kLanes> at{};
  for (std::size_t lane = 0; lane < RayLanes::kLanes; ++lane) {
    at[lane] = list.size() * lane / RayLanes::kLanes;
  }
  marker.mark([&](std::size_t lane, DrawnRay& ray) {
    const bool any = at[lane] < list.size() * (lane + 1) / RayLanes::kLanes;
    if (any) {
      ray = list[at[lane]++];
    }
    return any;
  });
}

// Draws blocks of rays. Each lane gets a contiguous part.
class BlockDrawer {
 public:
  BlockDrawer(const ScanRays& rays, const VoxelFrame& frame, std::size_t stride, ScanMarks& marks)
      : rays_(rays),
        frame_(frame),
        stride_(stride),
        of_tiles_(rays.are_tiles() ? rays.blocks_of_points(stride) : 0),
        marks_(marks) {}

  void draw(RayMarker& marker) {
    const std::size_t count = stride_ == 1 ? rays_.blocks() : of_tiles_;
    for (std::size_t lane = 0; lane < RayLanes::kLanes; ++lane) {
      lanes_[lane].next_block = count * lane / RayLanes::kLanes;
      lanes_[lane].end_block = count * (lane + 1) / RayLanes::kLanes;
    }
    marker.mark([this](std::size_t lane, DrawnRay& ray) { return next(lanes_[lane], ray); });
  }

 private:
  struct Lane {
    std::size_t next_block = 0;
    std::size_t end_block = 0;
    RayBlock block;
    std::uint64_t todo = 0;  // bit mask of the rays of the block that remain
    UndrawnPart part;
  };

  bool next(Lane& lane, DrawnRay& ray) {
    while (lane.todo == 0) {
      if (lane.next_block == lane.end_block) {
        return false;
      }
      load(lane);
    }
    const auto i = static_cast<std::size_t>(std::countr_zero(lane.todo));
    lane.todo &= lane.todo - 1;
    const RayBlock& block = lane.block;
    ray = {{block.end[0][i], block.end[1][i], block.end[2][i]},
           {block.cell[0][i], block.cell[1][i], block.cell[2][i]},
           lane.part.axis,
           lane.part.faces_before};
    return true;
  }

  void load(Lane& lane) {
    rays_.block(lane.next_block, stride_, lane.block);
    lane.todo = lane.block.all_hit() ? ~std::uint64_t{0} : 0;
    for (std::size_t i = 0; i < RayBlock::kRays && lane.todo != ~std::uint64_t{0}; ++i) {
      lane.todo |= std::uint64_t{lane.block.usable(i)} << i;
    }
    lane.part = {};
    if (lane.next_block < of_tiles_ && lane.todo != 0) {
      lane.part = undrawn_part(lane.block, lane.todo, rays_.origin(), frame_, marks_);
      lane.todo &= lane.part.rays;
    }
    ++lane.next_block;
  }

  const ScanRays& rays_;
  const VoxelFrame& frame_;
  std::size_t stride_;
  std::size_t of_tiles_;
  ScanMarks& marks_;
  std::array<Lane, RayLanes::kLanes> lanes_;
};

VANTAGE_INLINE void mark_rays(const ScanRays& rays, const VoxelFrame& frame, RayPolicy policy, ScanMarks& marks) {
  RayMarker marker(frame, rays.origin(), marks);
  if (policy == RayPolicy::EachEndCell) {
    draw(one_ray_per_end_cell(rays, frame, marks), marker);
    return;
  }
  for_each_block(rays, [&](const RayBlock& block) { mark_hits(block, marks, [](std::size_t) {}); });
  // For a depth image, draw every fourth row and column first. Where rays are closer than a cell, the other rays then
  // add nothing and are skipped.
  if (rays.are_tiles()) {
    constexpr std::size_t kEveryFourth = 4;
    BlockDrawer(rays, frame, kEveryFourth, marks).draw(marker);
  }
  BlockDrawer(rays, frame, 1, marks).draw(marker);
}

}  // namespace vantage::detail
