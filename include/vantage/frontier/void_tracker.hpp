// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vantage/compiler.hpp>
#include <vantage/frontier/void_tiles.hpp>
#include <vantage/geometry/lattice_hull.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The void cells of a map, kept up to date from what changed in it alone (Dornhege & Kleiner 2011, IV-B).
///
///     VoidTracker voids(map);
///     map.insert(scan);
///     voids.update();  // costs what the scan changed
///
/// At every moment it holds what `void_cells` would find in the map of the last update, whatever the way by which the
/// map came there. The hull grows by the occupied cells that a change has put outside it; where a corner of it is no
/// longer occupied it shrinks to the corners that are left and grows from there. Of the cells, only those are asked
/// again that lie beyond a plane which bounded the hull before, or does now, but not both. The map must outlive the
/// tracker.
class VoidTracker {
 public:
  /// Takes the map as it is now.
  explicit VoidTracker(const OccupancyMap& map);

  /// Follows the changes of the map since the last call. Returns whether the hull has changed.
  bool update();

  /// The hull of the occupied cells, as `occupied_hull`.
  [[nodiscard]] const LatticeHull& hull() const { return hull_; }
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

  [[nodiscard]] bool has_lost_a_corner() const;
  void start_anew();
  void shrink(std::vector<VoxelIndex>& touched);
  void widen(const std::vector<VoxelIndex>& touched);
  void reshape(LatticeHull hull, std::vector<VoxelIndex>* reshaped = nullptr);
  BrickVoids& brick_at(const VoxelIndex& address);
  void refresh(BrickVoids& brick);
  void collect_outside(const VoxelIndex& address, std::vector<VoxelIndex>& cells) const;

  const OccupancyMap* map_;
  OccupancyMap::Revision revision_ = 0;
  LatticeHull hull_;
  std::vector<LatticeHull::Plane> planes_;  // of the hull
  std::vector<VoxelIndex> corners_;         // of the hull
  VoidTiles tiles_;
  std::size_t cell_count_ = 0;
  std::unordered_map<VoxelIndex, std::uint32_t> numbers_;  // of the bricks that the hull reaches into
  std::vector<BrickVoids> bricks_;
};

}  // namespace vantage
