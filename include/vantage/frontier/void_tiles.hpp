// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Where cells of a map may be void: the tiles of 8 x 8 x 8 bricks (64 cells along an edge) that hold a brick of the
/// map, and the 26 around each of them. So a void cell is nowhere further than two tiles from what the map holds,
/// every cell of the hull within one tile of it may be void, and looking for voids costs what is known, however far
/// apart it lies: a hull may span a thousand times as much.
class VoidTiles {
 public:
  /// No tiles.
  VoidTiles() = default;
  /// Those of a map.
  explicit VoidTiles(const OccupancyMap& map);

  /// Adds those that a brick of the map brings.
  void add(const VoxelIndex& brick);
  /// All of them, by address: in the order in which they were added.
  [[nodiscard]] const std::vector<VoxelIndex>& tiles() const { return tiles_; }
  /// The bricks of a tile.
  [[nodiscard]] static VoxelBox bricks_of(const VoxelIndex& tile) {
    return {{tile.x * 8, tile.y * 8, tile.z * 8}, {tile.x * 8 + 8, tile.y * 8 + 8, tile.z * 8 + 8}};
  }

 private:
  VoxelTable<bool> held_;  // tiles that hold a brick
  VoxelTable<bool> near_;
  std::vector<VoxelIndex> tiles_;
};

}  // namespace vantage
