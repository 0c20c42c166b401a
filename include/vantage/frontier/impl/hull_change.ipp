// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/frontier/impl/hull_change.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <vantage/frontier/impl/hull_rows.hpp>
#include <vantage/frontier/impl/lattice_point.hpp>
#include <vantage/frontier/impl/on_facet.hpp>
#include <vantage/geometry/impl/along.hpp>
#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/geometry/impl/plane_distance.hpp>
#include <vantage/map/impl/brick_plane.hpp>

namespace vantage::detail {

// Splits a box into two halves across an axis.
inline std::pair<VoxelBox, VoxelBox> halves(const VoxelBox& box, std::size_t axis) {
  VoxelIndex low_end = box.hi;
  VoxelIndex high_start = box.lo;
  along(low_end, axis) = along(high_start, axis) = along(box.lo, axis) + along(box.extent(), axis) / 2;
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
  const double slope = plane.normal.x();
  std::uint64_t cells = 0;
  for (std::int32_t row = 15; row >= 0; --row) {
    const double start = distance_from(plane, lattice_point(first + VoxelIndex{0, row & 3, row >> 2})) - kOnFacet;
    const std::uint64_t in_row = std::uint64_t{start <= 0.0} | std::uint64_t{start + slope <= 0.0} << 1U |
                                 std::uint64_t{start + 2.0 * slope <= 0.0} << 2U |
                                 std::uint64_t{start + 3.0 * slope <= 0.0} << 3U;
    cells = cells << 4U | in_row;
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
  cells_ = box_around(box_around(before.corners), box_around(now.corners));
}

VANTAGE_INLINE VoxelBox HullChange::cells_of(const VoxelBox& bricks) const {
  return box_overlap(Brick::cells_of(bricks), cells_);
}

VANTAGE_INLINE void HullChange::for_each_brick(const VoxelBox& bricks, const Visit& visit) {
  (void)growth(
      bricks, [](const VoxelBox&) { return true; }, visit);
}

VANTAGE_INLINE std::int64_t HullChange::growth(const VoxelBox& bricks, const Holds& holds, const Visit& visit) {
  growth_ = 0;
  if (const VoxelBox overlap = Brick::over(cells_of(bricks)); !overlap.empty()) {
    visit_box(overlap, {0, common_.size()}, {0, gone_.size()}, {0, added_.size()}, holds, visit);
  }
  return growth_;
}

VANTAGE_INLINE void HullChange::visit_box(const VoxelBox& bricks, const Cutting& common, const Cutting& gone,
                                          const Cutting& added, const Holds& holds, const Visit& visit) {
  const VoxelBox cells = cells_of(bricks);
  const Cutting gone_here = narrow(gone_, gone, cells);
  const Cutting added_here = narrow(added_, added, cells);
  const bool outside_both = gone_here.beyond && added_here.beyond;
  if (!outside_both && !(gone_here.empty() && added_here.empty())) {
    const Cutting common_here = narrow(common_, common, cells);
    const bool held = holds(bricks);
    const bool gained = common_here.empty() && added_here.empty() && gone_here.beyond;
    const bool lost = common_here.empty() && gone_here.empty() && added_here.beyond;
    Eigen::Index flattest = 0;  // the axis along which the planes of only one hull run
    (void)(gone_here.slopes + added_here.slopes).minCoeff(&flattest);
    const auto axis = static_cast<std::size_t>(flattest);
    const VoxelIndex extent = bricks.extent();
    std::array<std::int32_t, 3> sides{extent.x, extent.y, extent.z};
    if (!held) {
      sides[axis] = 1;
    }
    const auto longest = std::max_element(sides.begin(), sides.end());
    if (common_here.beyond) {
      // nothing of it is left to look at
    } else if (!held && (gained || lost)) {
      growth_ += gained ? static_cast<std::int64_t>(cells.size()) : -static_cast<std::int64_t>(cells.size());
    } else if (*longest > 1) {
      const auto [low, high] = halves(bricks, static_cast<std::size_t>(longest - sides.begin()));
      visit_box(low, common_here, gone_here, added_here, holds, visit);
      visit_box(high, common_here, gone_here, added_here, holds, visit);
    } else if (held) {
      visit(bricks.lo, inside(bricks.lo, common_here, added_here));
    } else {
      count_rows(cells, axis, common_here, gone_here, added_here);
    }
    common_.resize(common_here.first);
  }
  gone_.resize(gone_here.first);
  added_.resize(added_here.first);
}

// Counts the cells of a box by rows along an axis.
VANTAGE_INLINE void HullChange::count_rows(const VoxelBox& cells, std::size_t axis, const Cutting& common,
                                           const Cutting& gone, const Cutting& added) {
  const std::size_t beside = (axis + 1) % 3;
  const std::size_t above = (axis + 2) % 3;
  const HullRows both(of(common_, common), axis);
  const HullRows before(of(gone_, gone), axis);
  const HullRows now(of(added_, added), axis);
  const HullRow whole{1.0 * along(cells.lo, axis), along(cells.hi, axis) - 1.0};
  for (std::int32_t v = along(cells.lo, above); v < along(cells.hi, above); ++v) {
    for (std::int32_t u = along(cells.lo, beside); u < along(cells.hi, beside); ++u) {
      const HullRow row = both.within(whole, u, v);
      growth_ += now.within(row, u, v).size() - before.within(row, u, v).size();
    }
  }
}

VANTAGE_INLINE std::span<const HullPlane> HullChange::of(const Planes& planes, const Cutting& cutting) {
  return std::span(planes).subspan(cutting.first, cutting.last - cutting.first);
}

// Pushes the planes beyond which a part of the box lies.
VANTAGE_INLINE HullChange::Cutting HullChange::narrow(Planes& planes, const Cutting& from, const VoxelBox& cells) {
  const PointBox box(cells);
  Cutting cutting{planes.size(), planes.size()};
  for (std::size_t i = from.first; i < from.last; ++i) {
    const HullPlane plane = planes[i];
    const double distance = distance_from(plane, box.middle) - kOnFacet;
    const double reach = box.reach(plane) + kOnFacet;  // adds a margin for rounding
    if (distance > -reach) {
      planes.push_back(plane);
      cutting.slopes += plane.normal.cwiseAbs();
      cutting.beyond = cutting.beyond || distance > reach;
    }
  }
  cutting.last = planes.size();
  return cutting;
}

// The cells of a brick inside the new hull.
VANTAGE_INLINE BrickPlane HullChange::inside(const VoxelIndex& brick, const Cutting& common,
                                             const Cutting& added) const {
  if (added.beyond) {
    return {};
  }
  BrickPlane inside = plane_of(brick, cells_);
  const auto cut_by = [&](const HullPlane& plane) {
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      const VoxelIndex first = Brick::cell_at(brick, word * 64);
      const PointBox box({first, first + VoxelIndex{4, 4, 4}});
      const double distance = inside[word] == 0 ? 0.0 : distance_from(plane, box.middle) - kOnFacet;
      const double reach = box.reach(plane) + kOnFacet;  // adds a margin for rounding
      if (distance > reach) {
        inside[word] = 0;
      } else if (distance > -reach && inside[word] != 0) {
        inside[word] &= cells_within(plane, first);
      }
    }
  };
  std::ranges::for_each(of(common_, common), cut_by);
  std::ranges::for_each(of(added_, added), cut_by);
  return inside;
}

}  // namespace vantage::detail
