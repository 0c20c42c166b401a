// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/frontier/impl/hull_change.hpp>
#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/map/impl/connected_cells.hpp>

namespace vantage {
namespace detail {

// Whether all cells that can become known lie in one plane, so that the hull is always empty.
inline bool is_one_layer(const OccupancyMap& map) {
  if (!map.region()) {
    return false;
  }
  const VoxelIndex extent = map.region()->extent();
  return std::min({extent.x, extent.y, extent.z}) <= 1;
}

}  // namespace detail

VANTAGE_INLINE VoidTracker::VoidTracker(const OccupancyMap& map)
    : map_(&map), connected_(std::make_unique<detail::ConnectedCells>()) {
  update();
}
VANTAGE_INLINE VoidTracker::VoidTracker(VoidTracker&&) noexcept = default;
VANTAGE_INLINE VoidTracker& VoidTracker::operator=(VoidTracker&&) noexcept = default;
VANTAGE_INLINE VoidTracker::~VoidTracker() = default;

VANTAGE_INLINE bool VoidTracker::update() {
  std::vector<VoxelIndex> touched = map_->changed_since(revision_);
  revision_ = map_->revision();
  if (touched.empty() || detail::is_one_layer(*map_)) {
    return false;
  }
  if (hull_.empty()) {
    start_anew();
    return true;
  }
  widen(touched);
  const bool shrunk = has_lost_a_corner();
  if (shrunk) {
    shrink(touched);
  }
  std::vector<VoxelIndex> outside;
  for (const VoxelIndex& address : touched) {
    if (const auto known = numbers_.find(address); known != numbers_.end()) {
      refresh(bricks_[known->second]);
    }
    collect_outside(address, outside);
  }
  if (hull_.empty()) {
    start_anew();
  } else if (!outside.empty()) {
    LatticeHull grown = hull_;
    grown.insert(outside);
    reshape(std::move(grown));
  }
  return shrunk || !outside.empty();
}

VANTAGE_INLINE bool VoidTracker::has_lost_a_corner() const {
  return !std::all_of(corners_.begin(), corners_.end(),
                      [&](const VoxelIndex& corner) { return map_->at(corner) == Occupancy::Occupied; });
}

// Rebuilds everything from all occupied cells.
VANTAGE_INLINE void VoidTracker::start_anew() {
  numbers_.clear();
  bricks_.clear();
  cell_count_ = 0;
  voids_ = {};
  changed_.clear();
  *connected_ = {};
  behind_ = {};
  hull_ = {};
  planes_.clear();
  corners_.clear();
  tiles_ = VoidTiles(*map_);
  std::vector<VoxelIndex> cells;
  map_->for_each_brick(
      [&](const VoxelIndex& address, const Brick& brick) { detail::append(brick.occupied, address, cells); });
  reshape(LatticeHull(cells));
}

// Adds the tiles of the touched bricks, and finds the cells inside the hull in the new tiles.
VANTAGE_INLINE void VoidTracker::widen(const std::vector<VoxelIndex>& touched) {
  const std::size_t before = tiles_.tiles().size();
  for (const VoxelIndex& address : touched) {
    tiles_.add(address);
  }
  const std::span<const VoxelIndex> fresh = std::span(tiles_.tiles()).subspan(before);
  if (fresh.empty()) {
    return;
  }
  detail::HullChange({}, {planes_, corners_})
      .for_each_brick(fresh, [&](const VoxelIndex& address, const BrickPlane& inside) {
        BrickVoids& brick = brick_at(address);
        brick.inside = inside;
        refresh(brick);
      });
}

// Replaces the hull by the hull of those corners that are still occupied. Appends to `touched` the changed bricks,
// because their occupied cells may now lie outside.
VANTAGE_INLINE void VoidTracker::shrink(std::vector<VoxelIndex>& touched) {
  std::vector<VoxelIndex> left;
  std::copy_if(corners_.begin(), corners_.end(), std::back_inserter(left),
               [&](const VoxelIndex& corner) { return map_->at(corner) == Occupancy::Occupied; });
  reshape(LatticeHull(left), &touched);
}

// Replaces the hull, and updates the bricks where the set of cells inside it has changed.
VANTAGE_INLINE void VoidTracker::reshape(LatticeHull hull, std::vector<VoxelIndex>* reshaped) {
  std::vector<LatticeHull::Plane> planes = hull.planes();
  std::vector<VoxelIndex> corners = hull.corners();
  detail::HullChange change({planes_, corners_}, {planes, corners});
  change.for_each_brick(tiles_.tiles(), [&](const VoxelIndex& address, const BrickPlane& inside) {
    BrickVoids& brick = brick_at(address);
    brick.inside = inside;
    refresh(brick);
    if (reshaped != nullptr) {
      reshaped->push_back(address);
    }
  });
  hull_ = std::move(hull);
  planes_ = std::move(planes);
  corners_ = std::move(corners);
}

VANTAGE_INLINE VoidTracker::BrickVoids& VoidTracker::brick_at(const VoxelIndex& address) {
  const auto [known, is_new] = numbers_.try_emplace(address, static_cast<std::uint32_t>(bricks_.size()));
  if (is_new) {
    bricks_.push_back({address});
  }
  return bricks_[known->second];
}

// The region needs no test: it is a box, so the hull of cells inside it stays inside it.
VANTAGE_INLINE void VoidTracker::refresh(BrickVoids& brick) {
  const Brick* stored = map_->find_brick(brick.address);
  BrickPlane voids{};
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    voids[word] = brick.inside[word] & ~(stored == nullptr ? 0 : stored->known[word]);
  }
  const BrickPlane* const before = voids_.find(brick.address);
  const std::size_t count_before = before == nullptr ? 0 : detail::size_of(*before);
  if (voids_.assign(brick.address, voids)) {
    cell_count_ += detail::size_of(voids) - count_before;
    changed_.push_back(brick.address);
  }
}

VANTAGE_INLINE void VoidTracker::collect_outside(const VoxelIndex& address, std::vector<VoxelIndex>& cells) const {
  const Brick* brick = map_->find_brick(address);
  if (brick == nullptr) {
    return;
  }
  const auto known = numbers_.find(address);
  BrickPlane outside = brick->occupied;
  for (std::size_t word = 0; word < Brick::kWords && known != numbers_.end(); ++word) {
    outside[word] &= ~bricks_[known->second].inside[word];
  }
  detail::append(outside, address, cells);
}

VANTAGE_INLINE std::vector<VoxelIndex> VoidTracker::cells() const {
  std::vector<VoxelIndex> cells;
  cells.reserve(cell_count_);
  voids_.for_each_brick(
      [&](const VoxelIndex& brick, const BrickPlane& voids) { detail::append(voids, brick, cells); });
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  return cells;
}

VANTAGE_INLINE std::vector<VoxelIndex> VoidTracker::cells_behind(std::span<const VoxelIndex> frontier) {
  connected_->update(voids_, changed_);
  changed_.clear();
  std::vector<VoxelIndex> starts;
  for (const VoxelIndex& cell : frontier) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      if (contains(cell + step)) {
        starts.push_back(cell + step);
      }
    }
  }
  connected_->connect(starts,
                      [&](const VoxelIndex& brick, const BrickPlane& cells) { (void)behind_.assign(brick, cells); });
  std::vector<VoxelIndex> cells;
  behind_.for_each_brick(
      [&](const VoxelIndex& brick, const BrickPlane& behind) { detail::append(behind, brick, cells); });
  return cells;
}

}  // namespace vantage
