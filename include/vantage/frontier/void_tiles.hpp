// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The parts of space that are searched for void cells. Space is divided into tiles of 8 x 8 x 8 bricks (64 cells
/// along an edge). The searched tiles are those that hold a brick of the map, and the 26 tiles around each of them.
/// So a void cell is at most two tiles away from a brick of the map. The cost depends on the known volume and not on
/// the convex hull, which may be a thousand times larger.
class VoidTiles {
 public:
  /// Creates an empty set of tiles.
  VoidTiles() = default;
  /// Creates the tiles of a map.
  explicit VoidTiles(const OccupancyMap& map);

  /// Adds the tile of a brick of the map, and the tiles around it.
  void add(const VoxelIndex& brick);
  /// The addresses of all tiles (in units of tiles), in the order in which they were added.
  [[nodiscard]] const std::vector<VoxelIndex>& tiles() const { return tiles_; }
  /// Whether a tile is searched.
  [[nodiscard]] bool contains(const VoxelIndex& tile) const { return near_.find(tile) != nullptr; }
  /// The bricks of a tile that the map holds, one bit per brick (Brick::offset_of); null if there are none.
  [[nodiscard]] const BrickPlane* held(const VoxelIndex& tile) const { return held_.find(tile); }
  /// The bricks of a tile, as a box in units of bricks.
  [[nodiscard]] static VoxelBox bricks_of(const VoxelIndex& tile) {
    return {{tile.x * 8, tile.y * 8, tile.z * 8}, {tile.x * 8 + 8, tile.y * 8 + 8, tile.z * 8 + 8}};
  }
  /// The tile of a cell.
  [[nodiscard]] static VoxelIndex of_cell(const VoxelIndex& cell) { return Brick::of_cell(Brick::of_cell(cell)); }
  /// The cells of a tile.
  [[nodiscard]] static VoxelBox cells_of(const VoxelIndex& tile) {
    const VoxelBox bricks = bricks_of(tile);
    return {Brick::cells_of(bricks.lo).lo, Brick::cells_of(bricks.hi).lo};
  }

 private:
  BrickSet held_;  // bricks of the map
  VoxelTable<bool> near_;
  std::vector<VoxelIndex> tiles_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/void_tiles.ipp>
#endif
