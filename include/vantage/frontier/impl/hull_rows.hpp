// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vantage/geometry/lattice_hull.hpp>
#include <vector>

#include <vantage/frontier/impl/on_facet.hpp>

namespace vantage::detail {

/// A part of a row of cells along an axis: those whose coordinate lies in [lo, hi].
struct HullRow {
  double lo = 0.0;
  double hi = -1.0;

  /// The cells [first, last); first == last if there are none.
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> cells() const {
    if (lo > hi) {
      return {0, 0};
    }
    const auto up = static_cast<std::int32_t>(lo);
    const auto down = static_cast<std::int32_t>(hi);
    return {up < lo ? up + 1 : up, down > hi ? down : down + 1};  // rounds up and down
  }
  [[nodiscard]] std::int64_t size() const {
    const auto [first, last] = cells();
    return last - first;
  }
};

/// Cuts rows of cells along an axis by planes.
class HullRows {
 public:
  HullRows(std::span<const HullPlane> planes, std::size_t axis) {
    constexpr double kAlong = 1e-15;  // a plane along the rows meets them far away, on the side that is right
    for (const HullPlane& plane : planes) {
      const auto normal = [&](std::size_t step) {
        return plane.normal[static_cast<Eigen::Index>((axis + step) % 3)];
      };
      const double slope = std::abs(normal(0)) < kAlong ? kAlong : normal(0);
      bounds_.push_back({slope > 0.0, (kOnFacet - plane.offset) / slope, -normal(1) / slope, -normal(2) / slope});
    }
  }

  /// The part of a row whose cells have their centres inside all planes. (u, v): its coordinates along the other
  /// axes, in cyclic order.
  [[nodiscard]] HullRow within(HullRow row, double u, double v) const {
    for (const Bound& bound : bounds_) {
      const double at = bound.start + bound.by_u * u + bound.by_v * v;
      (bound.is_upper ? row.hi : row.lo) = bound.is_upper ? std::min(row.hi, at) : std::max(row.lo, at);
    }
    return row;
  }

 private:
  // A plane meets the row (u, v) at start + by_u u + by_v v.
  struct Bound {
    bool is_upper;
    double start;
    double by_u;
    double by_v;
  };

  std::vector<Bound> bounds_;
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
