// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

#include "map/brick_plane.hpp"
#include "frontier/hull_change.hpp"

namespace vantage {
namespace {

// Whether all cells that can become known lie in one plane, so that the hull is always empty.
bool is_one_layer(const OccupancyMap& map) {
  if (!map.region()) {
    return false;
  }
  const VoxelIndex extent = map.region()->extent();
  return std::min({extent.x, extent.y, extent.z}) <= 1;
}

}  // namespace

VoidTracker::VoidTracker(const OccupancyMap& map) : map_(&map) { update(); }

bool VoidTracker::update() {
  std::vector<VoxelIndex> touched = map_->changed_since(revision_);
  revision_ = map_->revision();
  if (touched.empty() || is_one_layer(*map_)) {
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

bool VoidTracker::has_lost_a_corner() const {
  return !std::all_of(corners_.begin(), corners_.end(),
                      [&](const VoxelIndex& corner) { return map_->at(corner) == Occupancy::Occupied; });
}

// Rebuilds everything from all occupied cells.
void VoidTracker::start_anew() {
  numbers_.clear();
  bricks_.clear();
  cell_count_ = 0;
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
void VoidTracker::widen(const std::vector<VoxelIndex>& touched) {
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
void VoidTracker::shrink(std::vector<VoxelIndex>& touched) {
  std::vector<VoxelIndex> left;
  std::copy_if(corners_.begin(), corners_.end(), std::back_inserter(left),
               [&](const VoxelIndex& corner) { return map_->at(corner) == Occupancy::Occupied; });
  reshape(LatticeHull(left), &touched);
}

// Replaces the hull, and updates the bricks where the set of cells inside it has changed.
void VoidTracker::reshape(LatticeHull hull, std::vector<VoxelIndex>* reshaped) {
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

VoidTracker::BrickVoids& VoidTracker::brick_at(const VoxelIndex& address) {
  const auto [known, is_new] = numbers_.try_emplace(address, static_cast<std::uint32_t>(bricks_.size()));
  if (is_new) {
    bricks_.push_back({address});
  }
  return bricks_[known->second];
}

// The region needs no test: it is a box, so the hull of cells inside it stays inside it.
void VoidTracker::refresh(BrickVoids& brick) {
  const Brick* stored = map_->find_brick(brick.address);
  cell_count_ -= detail::size_of(brick.voids);
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    brick.voids[word] = brick.inside[word] & ~(stored == nullptr ? 0 : stored->known[word]);
  }
  cell_count_ += detail::size_of(brick.voids);
}

void VoidTracker::collect_outside(const VoxelIndex& address, std::vector<VoxelIndex>& cells) const {
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

bool VoidTracker::contains(const VoxelIndex& cell) const {
  const auto known = numbers_.find(Brick::of_cell(cell));
  const std::size_t offset = Brick::offset_of(cell);
  return known != numbers_.end() && (bricks_[known->second].voids[offset / 64] >> (offset % 64) & 1U) != 0;
}

std::vector<VoxelIndex> VoidTracker::cells() const {
  std::vector<VoxelIndex> cells = unordered_cells();
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  return cells;
}

std::vector<VoxelIndex> VoidTracker::unordered_cells() const {
  std::vector<VoxelIndex> cells;
  cells.reserve(cell_count_);
  for (const BrickVoids& brick : bricks_) {
    detail::append(brick.voids, brick.address, cells);
  }
  return cells;
}

}  // namespace vantage
