// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/frontier/void_tiles.hpp>
#include <vantage/geometry/lattice_hull.hpp>
#include <vantage/map/brick_directory.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace vantage::detail {
class ConnectedCells;
class HullChange;
}  // namespace vantage::detail

namespace VANTAGE_EXPORT vantage {

/// The void cells of a map, updated incrementally from the map's change log.
///
///     VoidTracker voids(map);
///     map.insert(scan);
///     voids.update();  // cost depends on what the scan has changed
///
/// After each update it holds exactly the result of `void_cells`, whatever the history of the map. The hull grows by
/// new occupied cells outside it. If a corner of the hull is no longer occupied, the hull shrinks to the remaining
/// corners and grows again from there. A cell is tested again only if it lies beyond a plane that bounds only one of
/// the old and the new hull. While all occupied cells lie in one plane, there is no hull to grow, and each update
/// looks at the whole map; a map whose region is one layer of cells has no void cells and costs nothing.
///
/// Cells inside the hull are stored for bricks of the map only. Elsewhere all of them are void cells; they are
/// counted, and found from the planes of the hull where they are asked for. So memory follows what is known, and not
/// the volume of the hull. The map must outlive the tracker. (Dornhege & Kleiner 2011, IV-B.)
class VoidTracker {
 public:
  /// Computes the void cells of the map as it is now.
  explicit VoidTracker(const OccupancyMap& map);
  /// Not copyable.
  VoidTracker(const VoidTracker&) = delete;
  /// Not copyable.
  VoidTracker& operator=(const VoidTracker&) = delete;
  /// Moves the content.
  VoidTracker(VoidTracker&& other) noexcept;
  /// Moves the content.
  VoidTracker& operator=(VoidTracker&& other) noexcept;
  ~VoidTracker();

  /// Applies the changes of the map since the last call. Returns whether the hull may have changed; false means that
  /// it has not.
  bool update();

  /// The convex hull of the occupied cells, as `occupied_hull`.
  [[nodiscard]] const LatticeHull& hull() const { return hull_; }
  /// The number of void cells.
  [[nodiscard]] std::size_t cell_count() const { return cell_count_; }
  /// Whether a cell is a void cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const;
  /// All void cells in raster order (z, then y, then x), as `void_cells`.
  [[nodiscard]] std::vector<VoxelIndex> cells() const;
  /// The void cells behind a frontier: those that are connected, through faces of void cells, with a void cell beside
  /// one of the cells of `frontier`. Others are enclosed by known cells. Only the cells of tiles (VoidTiles) that
  /// overlap a box of `near` are returned, so the cost need not follow the volume of the hull.
  [[nodiscard]] BrickSet cells_behind(std::span<const VoxelIndex> frontier, std::span<const VoxelBox> near);

 private:
  // A brick of the map.
  struct Stored {
    VoxelIndex address;
    BrickPlane inside{};  // cells inside the hull
    BrickPlane voids{};   // those of them that are unknown
  };

  [[nodiscard]] bool has_lost_a_corner() const;
  void start_anew();
  void shrink(std::vector<VoxelIndex>& touched);
  void widen(const std::vector<VoxelIndex>& touched);
  void reshape(LatticeHull hull, std::vector<VoxelIndex>* reshaped = nullptr);
  void apply(detail::HullChange& change, const VoxelIndex& tile, std::vector<VoxelIndex>* reshaped);
  [[nodiscard]] Stored* find(const VoxelIndex& address);
  [[nodiscard]] const Stored* find(const VoxelIndex& address) const;
  void store(const VoxelIndex& address, const BrickPlane& inside);
  void refresh(Stored& brick);
  void collect_outside(const Stored& brick, std::vector<VoxelIndex>& cells) const;
  void fill(detail::HullChange& whole, const VoxelIndex& tile, std::span<BrickPlane> bricks) const;

  const OccupancyMap* map_;
  OccupancyMap::Revision revision_ = 0;
  LatticeHull hull_;
  std::vector<LatticeHull::Plane> planes_;  // of `hull_`, ascending
  std::vector<VoxelIndex> corners_;         // of `hull_`
  VoidTiles tiles_;
  std::size_t cell_count_ = 0;
  BrickDirectory numbers_;  // index in `bricks_` of each brick of the map
  std::deque<Stored> bricks_;
  std::unique_ptr<detail::ConnectedCells> connected_;
  BrickSet behind_;  // result of the last `cells_behind`
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/void_tracker.ipp>
#endif
