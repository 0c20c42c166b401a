// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/convex_hull.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace vantage {

/// The void cells of a map, kept up to date from what changed in it alone (Dornhege & Kleiner 2011, IV-B).
///
///     VoidTracker voids(map);
///     map.insert(scan);
///     voids.update();  // costs what the scan changed
///
/// At every moment it holds what `void_cells` would find in the map of the last update, whatever the way by which the
/// map came there. The hull grows by the occupied cells that a change has put outside it; only where a corner of it
/// is no longer occupied it is found anew, from the corners that are left and what lies outside of these. The map
/// must outlive the tracker.
class VoidTracker {
 public:
  /// Takes the map as it is now.
  explicit VoidTracker(const OccupancyMap& map);

  /// Follows the changes of the map since the last call. Returns whether the hull has changed.
  bool update();

  /// The hull of the occupied cells, as `occupied_hull`: in units of cells, the centre of cell (x, y, z) at (x, y,
  /// z).
  [[nodiscard]] const ConvexHull& hull() const { return hull_; }
  /// How many void cells there are.
  [[nodiscard]] std::size_t cell_count() const { return cell_count_; }
  /// Whether a cell is one of them.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const;
  /// All of them, in raster order: `void_cells` of the map.
  [[nodiscard]] std::vector<VoxelIndex> cells() const;
  /// The same in no particular order, sooner.
  [[nodiscard]] std::vector<VoxelIndex> unordered_cells() const;

 private:
  struct BrickVoids {
    VoxelIndex address;
    BrickPlane inside{};  // the hull
    BrickPlane voids{};
  };

  void find_anew();
  void enclose(ConvexHull hull);
  void enclose(const VoxelBox& bricks, const std::vector<const ConvexHull::Plane*>& planes);
  void refresh(BrickVoids& brick);
  void collect_outside(const VoxelIndex& address, const Brick& brick, std::vector<Eigen::Vector3d>& points) const;
  [[nodiscard]] bool is_occupied(const Eigen::Vector3d& corner) const;

  const OccupancyMap* map_;
  OccupancyMap::Revision revision_ = 0;
  ConvexHull hull_;
  std::size_t cell_count_ = 0;
  std::unordered_map<VoxelIndex, std::uint32_t> numbers_;  // of the bricks that the hull reaches into
  std::vector<BrickVoids> bricks_;
};

}  // namespace vantage
