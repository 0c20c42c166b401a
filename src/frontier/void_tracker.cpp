// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

#include "frontier/brick_plane.hpp"
#include "frontier/lattice_point.hpp"
#include "frontier/on_facet.hpp"

namespace vantage {
namespace {

constexpr BrickPlane kAll = [] {
  BrickPlane all{};
  all.fill(~std::uint64_t{0});
  return all;
}();

using Planes = std::vector<const ConvexHull::Plane*>;

// Those of the planes that cut the cells of a box; none at all where one has all of the box beyond it.
std::optional<Planes> cutting(const Planes& planes, const VoxelBox& cells) {
  const Eigen::Vector3d lo = detail::lattice_point(cells.lo);
  const Eigen::Vector3d hi = detail::lattice_point(cells.hi - VoxelIndex{1, 1, 1});
  const Eigen::Vector3d middle = 0.5 * (lo + hi);
  const Eigen::Vector3d half = 0.5 * (hi - lo);
  Planes cut;
  for (const ConvexHull::Plane* plane : planes) {
    const double distance = plane->distance(middle) - detail::kOnFacet;
    const double reach = plane->normal.cwiseAbs().dot(half) + detail::kOnFacet;
    if (distance > reach) {
      return std::nullopt;
    }
    if (distance > -reach) {
      cut.push_back(plane);
    }
  }
  return cut;
}

// The cells of a sub-brick within the planes.
std::uint64_t inside_word(const Planes& planes, const VoxelIndex& brick, std::size_t word) {
  const VoxelIndex first = Brick::first_cell(brick) + Brick::cell_at(word * 64);
  const std::optional<Planes> cut = cutting(planes, {first, first + VoxelIndex{4, 4, 4}});
  if (!cut) {
    return 0;
  }
  std::uint64_t inside = ~std::uint64_t{0};
  for (std::size_t bit = 0; bit < 64 && !cut->empty(); ++bit) {
    const Eigen::Vector3d point = detail::lattice_point(Brick::first_cell(brick) + Brick::cell_at(word * 64 + bit));
    const bool within = std::all_of(cut->begin(), cut->end(), [&](const ConvexHull::Plane* plane) {
      return plane->distance(point) <= detail::kOnFacet;
    });
    inside &= ~(std::uint64_t{!within} << bit);
  }
  return inside;
}

BrickPlane inside_plane(const Planes& planes, const VoxelIndex& brick) {
  if (planes.empty()) {
    return kAll;
  }
  BrickPlane inside{};
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    inside[word] = inside_word(planes, brick, word);
  }
  return inside;
}

// The two halves of a box, cut across its longest side.
std::pair<VoxelBox, VoxelBox> halves(const VoxelBox& box) {
  const VoxelIndex extent = box.extent();
  VoxelIndex low_end = box.hi;
  VoxelIndex high_start = box.lo;
  if (extent.x >= extent.y && extent.x >= extent.z) {
    low_end.x = high_start.x = box.lo.x + extent.x / 2;
  } else if (extent.y >= extent.z) {
    low_end.y = high_start.y = box.lo.y + extent.y / 2;
  } else {
    low_end.z = high_start.z = box.lo.z + extent.z / 2;
  }
  return {{box.lo, low_end}, {high_start, box.hi}};
}

// The bricks around some points.
VoxelBox bricks_around(const std::vector<Eigen::Vector3d>& points) {
  VoxelBox box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = points[i];
    const VoxelIndex brick =
        Brick::of_cell({static_cast<std::int32_t>(std::lround(p.x())), static_cast<std::int32_t>(std::lround(p.y())),
                        static_cast<std::int32_t>(std::lround(p.z()))});
    if (i == 0) {
      box = {brick, brick + VoxelIndex{1, 1, 1}};
    }
    box.lo = {std::min(box.lo.x, brick.x), std::min(box.lo.y, brick.y), std::min(box.lo.z, brick.z)};
    box.hi = {std::max(box.hi.x, brick.x + 1), std::max(box.hi.y, brick.y + 1), std::max(box.hi.z, brick.z + 1)};
  }
  return box;
}

}  // namespace

VoidTracker::VoidTracker(const OccupancyMap& map) : map_(&map) { update(); }

bool VoidTracker::update() {
  const std::vector<VoxelIndex> touched = map_->changed_since(revision_);
  revision_ = map_->revision();
  if (touched.empty()) {
    return false;
  }
  const std::vector<Eigen::Vector3d>& corners = hull_.corners();
  if (hull_.empty() || !std::all_of(corners.begin(), corners.end(), [&](const auto& c) { return is_occupied(c); })) {
    find_anew();
    return true;
  }
  std::vector<Eigen::Vector3d> points;
  for (const VoxelIndex& address : touched) {
    collect_outside(address, *map_->find_brick(address), points);
  }
  for (const VoxelIndex& address : touched) {
    if (const auto known = numbers_.find(address); known != numbers_.end()) {
      refresh(bricks_[known->second]);
    }
  }
  if (points.empty()) {
    return false;
  }
  points.insert(points.end(), corners.begin(), corners.end());
  enclose(ConvexHull(points));
  return true;
}

// From the corners that are left, and what is outside of these; where they span nothing, from all occupied cells.
void VoidTracker::find_anew() {
  std::vector<Eigen::Vector3d> points;
  std::copy_if(hull_.corners().begin(), hull_.corners().end(), std::back_inserter(points),
               [&](const auto& corner) { return is_occupied(corner); });
  numbers_.clear();
  bricks_.clear();
  cell_count_ = 0;
  hull_ = {};
  const ConvexHull left(points);
  if (left.empty()) {
    enclose(occupied_hull(*map_));
    return;
  }
  enclose(left);
  map_->for_each_brick(
      [&](const VoxelIndex& address, const Brick& brick) { collect_outside(address, brick, points); });
  enclose(ConvexHull(points));
}

// Takes a hull that holds the one before.
void VoidTracker::enclose(ConvexHull hull) {
  hull_ = std::move(hull);
  Planes planes;
  for (const ConvexHull::Plane& plane : hull_.planes()) {
    planes.push_back(&plane);
  }
  if (!hull_.empty()) {
    enclose(bricks_around(hull_.corners()), planes);
  }
}

// Only the planes that cut a box of bricks matter to its halves.
void VoidTracker::enclose(const VoxelBox& bricks, const std::vector<const ConvexHull::Plane*>& planes) {
  const std::optional<Planes> cut = cutting(planes, {Brick::first_cell(bricks.lo), Brick::first_cell(bricks.hi)});
  if (!cut) {
    return;
  }
  if (bricks.size() > 1) {
    const auto [low, high] = halves(bricks);
    enclose(low, *cut);
    enclose(high, *cut);
    return;
  }
  const auto [known, is_new] = numbers_.try_emplace(bricks.lo, static_cast<std::uint32_t>(bricks_.size()));
  if (is_new) {
    bricks_.push_back({bricks.lo});
  }
  BrickVoids& brick = bricks_[known->second];
  if (brick.inside != kAll) {
    brick.inside = inside_plane(*cut, bricks.lo);
    refresh(brick);
  }
}

// The hull of cells of the region, which is a box, does not leave it.
void VoidTracker::refresh(BrickVoids& brick) {
  const Brick* stored = map_->find_brick(brick.address);
  cell_count_ -= detail::size_of(brick.voids);
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    brick.voids[word] = brick.inside[word] & ~(stored == nullptr ? 0 : stored->known[word]);
  }
  cell_count_ += detail::size_of(brick.voids);
}

void VoidTracker::collect_outside(const VoxelIndex& address, const Brick& brick,
                                  std::vector<Eigen::Vector3d>& points) const {
  const auto known = numbers_.find(address);
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    const std::uint64_t inside = known == numbers_.end() ? 0 : bricks_[known->second].inside[word];
    for_each_offset(brick.occupied[word] & ~inside, word, [&](std::size_t offset) {
      points.push_back(detail::lattice_point(Brick::first_cell(address) + Brick::cell_at(offset)));
    });
  }
}

bool VoidTracker::is_occupied(const Eigen::Vector3d& corner) const {
  return map_->at({static_cast<std::int32_t>(std::lround(corner.x())),
                   static_cast<std::int32_t>(std::lround(corner.y())),
                   static_cast<std::int32_t>(std::lround(corner.z()))}) == Occupancy::Occupied;
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
