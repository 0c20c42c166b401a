// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/voxel.hpp>

#include <vantage/geometry/impl/box_distance.hpp>

namespace vantage::detail {

/// Distance between a segment and a box, metres. The squared distance along the segment is convex with a monotone
/// slope, so bisection finds the nearest point.
[[nodiscard]] inline double distance_to_segment(const Box& box, const Eigen::Vector3d& from,
                                                const Eigen::Vector3d& to) {
  const Eigen::Vector3d step = to - from;
  const auto outside = [&](double t) -> Eigen::Vector3d {
    const Eigen::Vector3d point = from + t * step;
    return (point - box.max).cwiseMax(0.0) - (box.min - point).cwiseMax(0.0);
  };
  const auto slope = [&](double t) { return outside(t).dot(step); };
  if (slope(0.0) >= 0.0) {
    return outside(0.0).norm();
  }
  if (slope(1.0) <= 0.0) {
    return outside(1.0).norm();
  }
  double below = 0.0;
  double above = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (below + above);
    (slope(middle) < 0.0 ? below : above) = middle;
  }
  return outside(0.5 * (below + above)).norm();
}

/// Below this distance between its centre and a cell, metres, a sphere touches the cell. A sphere that only touches
/// the boundary does not count; a sphere of radius 0 touches the cells through which its centre passes.
[[nodiscard]] inline double touching_distance_m(const VoxelFrame& frame, double radius_m) {
  const double graze_m = 1e-9 * frame.size_m;
  return std::max(radius_m - graze_m, graze_m);
}

/// Whether a sphere at rest touches a cell.
[[nodiscard]] inline bool sphere_touches(const VoxelFrame& frame, const Eigen::Vector3d& centre, double radius_m,
                                         const VoxelIndex& cell) {
  return frame.cell_of(centre) == cell ||
         distance_between(frame.box_of(cell), centre) < touching_distance_m(frame, radius_m);
}

/// Bounding box of the cells that a sphere can touch in one slab while its centre moves from `from` to `to` (metres,
/// world). A slab is all cells with coordinate `slab` along `axis`.
[[nodiscard]] inline VoxelBox swept_cells_in_slab(const VoxelFrame& frame, const Eigen::Vector3d& from,
                                                  const Eigen::Vector3d& to, double radius_m, Eigen::Index axis,
                                                  std::int32_t slab) {
  const double length = to[axis] - from[axis];
  double t0 = 0.0;
  double t1 = 1.0;
  if (std::abs(length) > 1e-12) {
    const double enters = (slab * frame.size_m - radius_m - from[axis]) / length;
    const double leaves = ((slab + 1) * frame.size_m + radius_m - from[axis]) / length;
    t0 = std::clamp(std::min(enters, leaves), 0.0, 1.0);
    t1 = std::clamp(std::max(enters, leaves), 0.0, 1.0);
  }
  const Eigen::Vector3d a = from + t0 * (to - from);
  const Eigen::Vector3d b = from + t1 * (to - from);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m);
  VoxelIndex lo = frame.cell_of(a.cwiseMin(b) - reach);
  VoxelIndex hi = frame.cell_of(a.cwiseMax(b) + reach) + VoxelIndex{1, 1, 1};
  (axis == 0 ? lo.x : axis == 1 ? lo.y : lo.z) = slab;
  (axis == 0 ? hi.x : axis == 1 ? hi.y : hi.z) = slab + 1;
  return {lo, hi};
}

/// Range of layers in z: from `lo` (included) to `hi` (excluded).
struct Layers {
  std::int32_t lo = std::numeric_limits<std::int32_t>::min();
  std::int32_t hi = std::numeric_limits<std::int32_t>::max();
};

/// Whether `clear(cell)` holds for all cells in `layers` that a sphere touches while its centre moves from `from` to
/// `to` (metres, world). The cells of both ends are always tested.
template <class Clear>
[[nodiscard]] bool swept_sphere_is_clear(const VoxelFrame& frame, const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& to, double radius_m, Clear&& clear,
                                         const Layers& layers = {}) {
  if (!clear(frame.cell_of(from)) || !clear(frame.cell_of(to))) {
    return false;
  }
  const double touching_m = touching_distance_m(frame, radius_m);
  Eigen::Index axis = 0;
  (to - from).cwiseAbs().maxCoeff(&axis);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m);
  const auto along = [axis](const VoxelIndex& cell) { return axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z; };
  const std::int32_t first = along(frame.cell_of(from.cwiseMin(to) - reach));
  const std::int32_t last = along(frame.cell_of(from.cwiseMax(to) + reach));
  for (std::int32_t slab = first; slab <= last; ++slab) {
    const VoxelBox cells = swept_cells_in_slab(frame, from, to, radius_m, axis, slab);
    for (std::int32_t z = std::max(cells.lo.z, layers.lo); z < std::min(cells.hi.z, layers.hi); ++z) {
      for (std::int32_t y = cells.lo.y; y < cells.hi.y; ++y) {
        for (std::int32_t x = cells.lo.x; x < cells.hi.x; ++x) {
          const VoxelIndex cell{x, y, z};
          if (!clear(cell) && distance_to_segment(frame.box_of(cell), from, to) < touching_m) {
            return false;
          }
        }
      }
    }
  }
  return true;
}

}  // namespace vantage::detail
