// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vantage/geometry/lattice_hull.hpp>
#include <vector>

#include <vantage/frontier/impl/on_facet.hpp>
#include <vantage/geometry/impl/plane_distance.hpp>

namespace vantage::detail {

/// The cells [first, last) of a row along an axis.
struct HullRow {
  std::int32_t first = 0;
  std::int32_t last = 0;

  [[nodiscard]] std::int64_t size() const { return last - first; }
  /// Those whose centre lies inside all planes. `start`: the point of the row whose coordinate along `axis` is 0.
  [[nodiscard]] HullRow within(std::span<const HullPlane> planes, const Eigen::Vector3d& start,
                               Eigen::Index axis) const {
    constexpr double kAlong = 1e-12;  // a plane with a smaller slope runs along the row
    double lo = first;
    double hi = last - 1;
    for (const HullPlane& plane : planes) {
      const double slope = plane.normal[axis];
      const double rest = distance_from(plane, start) - kOnFacet;
      if (slope > kAlong) {
        hi = std::min(hi, std::floor(-rest / slope));
      } else if (slope < -kAlong) {
        lo = std::max(lo, std::ceil(-rest / slope));
      } else if (rest > 0.0) {
        return {first, first};
      }
    }
    return lo <= hi ? HullRow{static_cast<std::int32_t>(lo), static_cast<std::int32_t>(hi) + 1}
                    : HullRow{first, first};
  }
};

/// The planes of a hull.
[[nodiscard]] inline std::vector<HullPlane> planes_of(const LatticeHull& hull) {
  std::vector<HullPlane> planes;
  for (const LatticeHull::Plane& plane : hull.planes()) {
    planes.push_back(plane.plane());
  }
  return planes;
}

}  // namespace vantage::detail
