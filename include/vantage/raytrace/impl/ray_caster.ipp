// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/impl/single_walk.hpp>
#include <vantage/raytrace/impl/slice_walk.hpp>
#include <vantage/raytrace/impl/view_culling.hpp>
#include <vantage/raytrace/impl/view_placer.hpp>
#include <vantage/raytrace/impl/view_walk.hpp>
#include <vantage/raytrace/ray_caster.hpp>

#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/geometry/impl/prefetch.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline constexpr VoxelBox kEverywhere{{-kFurthestVoxel, -kFurthestVoxel, -kFurthestVoxel},
                                      {kFurthestVoxel, kFurthestVoxel, kFurthestVoxel}};

// Prefetches all cache lines of an object.
template <class T>
void prefetch_whole(const T& object) {
  constexpr std::size_t kLine = 64;
  const auto* const bytes = reinterpret_cast<const char*>(&object);
  for (std::size_t at = 0; at < sizeof(T); at += kLine) {
    detail::prefetch(bytes + at);
  }
}

inline RayCasterOptions validated(const RayCasterOptions& options) {
  detail::require_option(options.level >= 0 && options.level <= 16, "RayCasterOptions::level", options.level,
                         "in [0, 16]");
  return options;
}

// Erases the cells that are nearer to `origin` than the minimum range of a sensor. It does not see them, but they
// hide what lies behind them.
inline void erase_nearer(CellSet& seen, const VoxelFrame& frame, const Eigen::Vector3d& origin, double min_range_m) {
  if (frame.box_of(seen.box()).distance_to(origin) >= min_range_m) {
    return;
  }
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(min_range_m + frame.size_m);
  const VoxelBox near{frame.cell_of(origin - around), frame.cell_of(origin + around)};
  for_each_cell(box_overlap(seen.box(), near), [&](const VoxelIndex& cell) {
    if ((frame.centre_of(cell) - origin).norm() < min_range_m) {
      seen.erase(cell);
    }
  });
}

}  // namespace detail

VANTAGE_INLINE RayCaster::RayCaster(const OccupancyMap& map, const RayCasterOptions& options)
    : map_(&map),
      options_(detail::validated(options)),
      frame_{map.resolution_m() * static_cast<double>(1 << options.level)},
      grid_(std::make_unique<detail::BlockingGrid>(options.level, options.policy)) {
  update();
}
VANTAGE_INLINE RayCaster::~RayCaster() = default;
VANTAGE_INLINE RayCaster::RayCaster(RayCaster&&) noexcept = default;
VANTAGE_INLINE RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

VANTAGE_INLINE std::size_t RayCaster::update() { return grid_->update(*map_); }

VANTAGE_INLINE void RayCaster::suppose(const CellSet& stopping) { grid_->suppose(stopping); }

VANTAGE_INLINE Occupancy RayCaster::at(const VoxelIndex& cell) const { return grid_->at(cell); }

VANTAGE_INLINE std::size_t RayCaster::memory_bytes() const { return sizeof(*this) + grid_->memory_bytes(); }

VANTAGE_INLINE RayEnd RayCaster::cast(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  if (!frame_.addressable(from) || !frame_.addressable(to)) {
    throw std::invalid_argument("RayCaster::cast: both ends must be finite and addressable");
  }
  detail::SingleWalk walk(frame_, from, frame_.cell_of(from), to, frame_.cell_of(to));
  walk.advance(*grid_);
  return {walk.cell(), grid_->at(walk.cell())};
}

VANTAGE_INLINE void RayCaster::cast(const Pose& world_from_sensor, const ViewRays& rays,
                                    std::span<RayEnd> ends) const {
  if (ends.size() != rays.size()) {
    throw std::invalid_argument("RayCaster::cast: there must be one end for every ray of the view");
  }
  const detail::RayPlacer placer = detail::view_placer(world_from_sensor, rays, frame_);
  detail::SliceWalk walk(*grid_, frame_, world_from_sensor.translation(), detail::best_instruction_set());
  detail::RayBlock block;
  detail::TileHits hits(detail::best_instruction_set());
  VoxelIndex last;
  std::uint64_t occupied = grid_->occupied(CellSet::word_of(last));
  for (std::size_t n = 0; n < rays.tiles().size(); ++n) {
    const RayTile& tile = rays.tiles()[n];
    detail::prefetch_whole(rays.tiles()[std::min(n + 1, rays.tiles().size() - 1)]);
    for (std::size_t i = 0; i < RayTile::kRays; i += 4) {  // ends of four successive rays share a cache line
      detail::prefetch_to_write(&ends[tile.ray[i]]);
    }
    placer.place_ends(tile.directions, tile.stretch, block);
    hits.stopped = 0;
    walk.cast(block, tile.rays, detail::kEverywhere, 0.0, hits);
    std::uint64_t left = tile.rays & ~hits.stopped;
    if (left != 0) {
      placer.place_cells(block);
    }
    // Unknown cells stop rays, too. So a ray that nothing stops ends in a free cell.
    for (; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      RayEnd& end = ends[tile.ray[i]];
      end.cell = {block.cell[0][i], block.cell[1][i], block.cell[2][i]};
      end.occupancy = Occupancy::Free;
    }
    for (left = hits.stopped; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const VoxelIndex cell = hits.cell_at(i);
      const VoxelIndex by = {cell.x ^ last.x, cell.y ^ last.y, cell.z ^ last.z};
      if (((by.x | by.y | by.z) & ~3) != 0) {  // rare, because neighbouring rays end in neighbouring cells
        occupied = grid_->occupied(CellSet::word_of(cell));
        last = cell;
      }
      const bool is_occupied = (occupied & CellSet::bit_of(cell)) != 0;
      RayEnd& end = ends[tile.ray[i]];
      end.cell = cell;
      end.occupancy = is_occupied ? Occupancy::Occupied : Occupancy::Unknown;
    }
  }
}

VANTAGE_INLINE CellSet RayCaster::visible_cells(const Pose& world_from_sensor, const ViewRays& rays,
                                                const VoxelBox& box) const {
  CellSet seen(box);
  if (box.empty()) {
    return seen;
  }
  const detail::InstructionSet set = detail::best_instruction_set();
  const detail::RayPlacer placer = detail::view_placer(world_from_sensor, rays, frame_);
  const detail::BoxCulling culling(world_from_sensor, frame_.box_of(box), set);
  detail::FreeCone free_cone(*grid_, frame_, world_from_sensor);
  detail::SliceWalk walk(*grid_, frame_, world_from_sensor.translation(), set);
  detail::ViewWalk together(walk, world_from_sensor, box, set);
  detail::CellStamps stamps(seen, set);
  detail::ViewWalk::Outlook outlook;
  detail::RayBlock block;
  constexpr double kLooseness = 1e-5;  // tolerance for rotations that are not exactly orthonormal
  // If all rays end behind the box, their lengths do not matter, and ViewWalk follows whole groups of tiles.
  const bool end_behind = culling.furthest_m() < (1.0 - kLooseness) * rays.max_range_m();
  for (std::size_t g = 0; g < rays.groups().size(); ++g) {
    const TileGroup& group = rays.groups()[g];
    const detail::Meeting of_group = culling.meeting(group.cone);
    if (of_group == detail::Meeting::None) {
      continue;
    }
    double free_m = 0.0;
    if (end_behind) {
      if (!together.enter(group, rays.hulls()[g])) {
        continue;
      }
    } else {
      free_m = free_cone.free_m(group.cone, std::min(culling.furthest_m(), rays.max_range_m()));
      if (free_m >= culling.furthest_m()) {
        continue;
      }
    }
    for (std::size_t i = group.first; i < group.last; ++i) {
      const RayCone& cone = rays.cones()[i];
      const detail::Meeting meeting = of_group == detail::Meeting::All ? detail::Meeting::All : culling.meeting(cone);
      if (meeting == detail::Meeting::None || (end_behind && !together.look(i - group.first, outlook))) {
        continue;
      }
      const RayTile& tile = rays.tiles()[i];
      detail::prefetch_whole(rays.tiles()[std::min(i + 1, group.last - 1)].directions);
      const bool selects = meeting == detail::Meeting::All || outlook.known == detail::ViewWalk::Known::Passages;
      std::uint64_t left = selects ? tile.rays : culling.meeting(tile);
      if (end_behind) {
        left = together.walk(tile, outlook, left, stamps);
      }
      if (left != 0) {
        placer.place_ends(tile.directions, tile.stretch, block);
        walk.cast(block, left, box, std::min(free_m / rays.max_range_m(), 1.0), stamps);
      }
    }
  }
  detail::erase_nearer(seen, frame_, world_from_sensor.translation(), rays.min_range_m());
  return seen;
}

VANTAGE_INLINE std::size_t RayCaster::count(const CellSet& cells, Occupancy occupancy) const {
  std::size_t count = 0;
  cells.for_each_word([&](const VoxelIndex& word, std::uint64_t set) {
    const std::uint64_t occupied = grid_->occupied(word);
    const std::uint64_t blocking = grid_->blocking(word);
    const std::uint64_t wanted = occupancy == Occupancy::Occupied ? occupied
                                 : occupancy == Occupancy::Free   ? ~blocking
                                                                  : blocking & ~occupied;
    count += static_cast<std::size_t>(std::popcount(set & wanted));
  });
  return count;
}

}  // namespace vantage
