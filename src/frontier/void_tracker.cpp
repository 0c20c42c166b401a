// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

#include "frontier/brick_plane.hpp"
#include "frontier/on_facet.hpp"

namespace vantage {
namespace {

constexpr BrickPlane kAll = [] {
  BrickPlane all{};
  all.fill(~std::uint64_t{0});
  return all;
}();

Eigen::Vector3d point_of(const VoxelIndex& cell) { return Eigen::Vector3d(cell.x, cell.y, cell.z); }

// The cells of a brick inside the hull. Most planes pass it by: either all of it is beyond one, or all within.
BrickPlane inside_plane(const ConvexHull& hull, const VoxelIndex& brick) {
  constexpr double kHalf = 0.5 * (Brick::kSide - 1);
  const Eigen::Vector3d middle = point_of(Brick::first_cell(brick)) + Eigen::Vector3d::Constant(kHalf);
  std::vector<const ConvexHull::Plane*> cutting;
  for (const ConvexHull::Plane& plane : hull.planes()) {
    const double distance = plane.distance(middle) - detail::kOnFacet;
    const double reach = kHalf * plane.normal.cwiseAbs().sum() + detail::kOnFacet;
    if (distance > reach) {
      return {};
    }
    if (distance > -reach) {
      cutting.push_back(&plane);
    }
  }
  if (cutting.empty()) {
    return kAll;
  }
  BrickPlane inside{};
  for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
    const Eigen::Vector3d point = point_of(Brick::first_cell(brick) + Brick::cell_at(offset));
    const bool within = std::all_of(cutting.begin(), cutting.end(), [&](const ConvexHull::Plane* plane) {
      return plane->distance(point) <= detail::kOnFacet;
    });
    inside[offset / 64] |= std::uint64_t{within} << (offset % 64);
  }
  return inside;
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
  for_each_cell(bricks_around(hull_.corners()), [&](const VoxelIndex& brick) { enclose(brick); });
}

void VoidTracker::enclose(const VoxelIndex& brick) {
  const auto known = numbers_.find(brick);
  if (known != numbers_.end() && bricks_[known->second].inside == kAll) {
    return;
  }
  const BrickPlane inside = inside_plane(hull_, brick);
  if (!detail::any(inside)) {
    return;
  }
  std::uint32_t number = static_cast<std::uint32_t>(bricks_.size());
  if (known == numbers_.end()) {
    numbers_.emplace(brick, number);
    bricks_.push_back({brick});
  } else {
    number = known->second;
  }
  bricks_[number].inside = inside;
  refresh(bricks_[number]);
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
      points.push_back(point_of(Brick::first_cell(address) + Brick::cell_at(offset)));
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
