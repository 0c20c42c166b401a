// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vantage/geometry/lattice_hull.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

#include <vantage/frontier/impl/on_facet.hpp>
#include <vantage/geometry/impl/plane_distance.hpp>

namespace vantage::detail {

/// The cells [first, last) of the row (., y, z) of a box whose centre lies inside all planes of a hull.
[[nodiscard]] inline std::pair<std::int32_t, std::int32_t> row_in_hull(std::span<const HullPlane> planes,
                                                                       const VoxelBox& box, std::int32_t y,
                                                                       std::int32_t z) {
  double lo = box.lo.x;
  double hi = box.hi.x - 1;
  for (const HullPlane& plane : planes) {
    const double slope = plane.normal.x();
    const double rest = distance_from(plane, {0.0, static_cast<double>(y), static_cast<double>(z)}) - kOnFacet;
    if (std::abs(slope) < 1e-12) {
      if (rest > 0.0) {
        return {box.lo.x, box.lo.x};
      }
    } else if (slope > 0.0) {
      hi = std::min(hi, std::floor(-rest / slope));
    } else {
      lo = std::max(lo, std::ceil(-rest / slope));
    }
  }
  return lo <= hi ? std::pair(static_cast<std::int32_t>(lo), static_cast<std::int32_t>(hi) + 1)
                  : std::pair(box.lo.x, box.lo.x);
}

/// The planes of a hull, for row_in_hull.
[[nodiscard]] inline std::vector<HullPlane> planes_of(const LatticeHull& hull) {
  std::vector<HullPlane> planes;
  for (const LatticeHull::Plane& plane : hull.planes()) {
    planes.push_back(plane.plane());
  }
  return planes;
}

}  // namespace vantage::detail
