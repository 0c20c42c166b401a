// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>
#include <vantage/geometry/hull_plane.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace vantage::test {

/// The convex hull of cells as Qhull computes it, in floating point: an oracle for LatticeHull. (Barber, Dobkin &
/// Huhdanpaa 1996.)
class QhullHull {
 public:
  /// Empty if the cells lie in one plane. Throws std::runtime_error if Qhull gives up.
  explicit QhullHull(std::span<const VoxelIndex> cells);

  [[nodiscard]] bool empty() const { return planes_.empty(); }
  /// The planes of all facets.
  [[nodiscard]] const std::vector<HullPlane>& planes() const { return planes_; }
  /// The cells that are corners of the hull.
  [[nodiscard]] const std::vector<VoxelIndex>& corners() const { return corners_; }
  /// Whether a cell lies in the hull, or at most `tolerance` beyond each of its planes.
  [[nodiscard]] bool contains(const VoxelIndex& cell, double tolerance = 1e-6) const;

 private:
  std::vector<HullPlane> planes_;
  std::vector<VoxelIndex> corners_;
};

/// The hull of all occupied cells of a map.
[[nodiscard]] QhullHull qhull_of_occupied(const OccupancyMap& map);

}  // namespace vantage::test
