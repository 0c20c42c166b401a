// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/frontier/impl/hull_change.hpp>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vantage/frontier/void_tiles.hpp>

#include <vantage/frontier/impl/lattice_point.hpp>
#include <vantage/frontier/impl/on_facet.hpp>
#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/geometry/impl/plane_distance.hpp>

namespace vantage::detail {

// Splits a box into two halves across its longest side.
inline std::pair<VoxelBox, VoxelBox> halves(const VoxelBox& box) {
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

// The bounding box of the centres of cells, as centre and half extent.
struct PointBox {
  Eigen::Vector3d middle;
  Eigen::Vector3d half;

  explicit PointBox(const VoxelBox& cells)
      : middle(0.5 * (lattice_point(cells.lo) + lattice_point(cells.hi - VoxelIndex{1, 1, 1}))),
        half(0.5 * lattice_point(cells.hi - cells.lo - VoxelIndex{1, 1, 1})) {}
  [[nodiscard]] double reach(const HullPlane& plane) const { return plane.normal.cwiseAbs().dot(half); }
};

// The cells of a sub-brick on the inner side of a plane.
inline std::uint64_t cells_within(const HullPlane& plane, const VoxelIndex& first) {
  std::uint64_t cells = 0;
  for (std::int32_t row = 0; row < 16; ++row) {
    const double start = distance_from(plane, lattice_point(first + VoxelIndex{0, row & 3, row >> 2})) - kOnFacet;
    for (std::int32_t x = 0; x < 4; ++x) {
      cells |= std::uint64_t{start + x * plane.normal.x() <= 0.0} << (row * 4 + x);
    }
  }
  return cells;
}

VANTAGE_INLINE HullChange::HullChange(const Hull& before, const Hull& now) {
  const auto less = [](const LatticeHull::Plane& a, const LatticeHull::Plane& b) { return a.normal < b.normal; };
  const auto matching = [&](std::span<const LatticeHull::Plane> planes, const LatticeHull::Plane& plane) {
    const auto found = std::lower_bound(planes.begin(), planes.end(), plane, less);
    return found != planes.end() && *found == plane;
  };
  for (const LatticeHull::Plane& plane : now.planes) {
    (matching(before.planes, plane) ? common_ : added_).push_back(plane.plane());
  }
  for (const LatticeHull::Plane& plane : before.planes) {
    if (!matching(now.planes, plane)) {
      gone_.push_back(plane.plane());
    }
  }
  // An empty hull is represented by a plane that has every cell beyond it.
  const HullPlane none{Eigen::Vector3d::Zero(), 1.0};
  if (before.planes.empty()) {
    gone_.push_back(none);
  }
  if (now.planes.empty()) {
    added_.push_back(none);
  }
  std::vector<VoxelIndex> bricks;
  for (const std::span<const VoxelIndex> corners : {before.corners, now.corners}) {
    std::transform(corners.begin(), corners.end(), std::back_inserter(bricks), Brick::of_cell);
  }
  bricks_ = box_around(bricks);
}

VANTAGE_INLINE void HullChange::for_each_brick(std::span<const VoxelIndex> tiles, const Visit& visit) {
  for (const VoxelIndex& tile : tiles) {
    const VoxelBox bricks = box_overlap(bricks_, VoidTiles::bricks_of(tile));
    if (!bricks.empty()) {
      visit_box(bricks, {0, common_.size()}, {0, gone_.size()}, {0, added_.size()}, visit);
    }
  }
}

VANTAGE_INLINE void HullChange::visit_box(const VoxelBox& bricks, const Cutting& common, const Cutting& gone,
                                          const Cutting& added, const Visit& visit) {
  const Cutting gone_here = narrow(gone_, gone, bricks);
  const Cutting added_here = narrow(added_, added, bricks);
  const bool outside_both = gone_here.beyond && added_here.beyond;
  if (!outside_both && !(gone_here.empty() && added_here.empty())) {
    const Cutting common_here = narrow(common_, common, bricks);
    if (!common_here.beyond && bricks.size() > 1) {
      const auto [low, high] = halves(bricks);
      visit_box(low, common_here, gone_here, added_here, visit);
      visit_box(high, common_here, gone_here, added_here, visit);
    } else if (!common_here.beyond) {
      visit(bricks.lo, inside(bricks.lo, common_here, added_here));
    }
    common_.resize(common_here.first);
  }
  gone_.resize(gone_here.first);
  added_.resize(added_here.first);
}

// Pushes the planes beyond which a part of the box lies.
VANTAGE_INLINE HullChange::Cutting HullChange::narrow(Planes& planes, const Cutting& from, const VoxelBox& bricks) {
  const PointBox box({Brick::first_cell(bricks.lo), Brick::first_cell(bricks.hi)});
  Cutting cutting{planes.size(), planes.size()};
  for (std::size_t i = from.first; i < from.last; ++i) {
    const HullPlane plane = planes[i];
    const double distance = distance_from(plane, box.middle) - kOnFacet;
    const double reach = box.reach(plane) + kOnFacet;  // adds a margin for rounding
    if (distance > -reach) {
      planes.push_back(plane);
      cutting.beyond = cutting.beyond || distance > reach;
    }
  }
  cutting.last = planes.size();
  return cutting;
}

VANTAGE_INLINE BrickPlane HullChange::inside(const VoxelIndex& brick, const Cutting& common,
                                             const Cutting& added) const {
  BrickPlane inside{};
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    const VoxelIndex first = Brick::first_cell(brick) + Brick::cell_at(word * 64);
    const PointBox box({first, first + VoxelIndex{4, 4, 4}});
    inside[word] = ~std::uint64_t{0};
    const auto cut_by = [&](const HullPlane& plane) {
      if (inside[word] != 0 && distance_from(plane, box.middle) + box.reach(plane) > 0.0) {
        inside[word] &= cells_within(plane, first);
      }
    };
    std::for_each_n(common_.begin() + static_cast<std::ptrdiff_t>(common.first), common.last - common.first, cut_by);
    std::for_each_n(added_.begin() + static_cast<std::ptrdiff_t>(added.first), added.last - added.first, cut_by);
  }
  return inside;
}

}  // namespace vantage::detail
