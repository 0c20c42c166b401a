// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick_set.hpp>
#include <vector>

namespace vantage::detail {

/// Which cells of a set are connected through faces, updated where the set changes.
///
///     brick  8 x 8 x 8 cells:   parts,  cells that are connected within the brick
///     tile   8 x 8 x 8 bricks:  groups, parts that are connected within the tile
///     links  pairs of groups in two tiles that share a face
///
///     +-- tile --------+-- tile --------+
///     | ##..##  group 0 ->- group 0     |
///     |    ######################       |
///     |                |                |
///     | ####  group 1  |  group 1 ####  |
///     +----------------+----------------+
///
/// A change in a brick renews the groups of its tile and the links to the six tiles beside it. To find what is
/// connected with some cells, only groups and links are visited: a few per tile, whatever its cells are.
class ConnectedCells {
 public:
  /// Updates the parts, groups and links. `cells`: the set, which is the same object in every call. `changed`: the
  /// bricks that have changed since the last call.
  void update(const BrickSet& cells, std::span<const VoxelIndex> changed);

  /// Finds the cells that are connected with any of `starts`; those outside the set are ignored. Calls `visit(brick
  /// address, const BrickPlane&)` with the connected cells of a brick, at least for each brick where they differ from
  /// those of the last call.
  template <class Visit>
  void connect(std::span<const VoxelIndex> starts, Visit&& visit);

 private:
  static constexpr std::size_t kBricks = 512;  // of a tile, numbered with x fastest
  struct Part {
    BrickPlane cells;
    std::uint32_t group;
  };
  using Link = std::pair<std::uint32_t, std::uint32_t>;  // group of this tile, group of the next one along the axis
  struct Tile {
    VoxelIndex address;
    std::vector<Part> parts = {};                    // ordered by brick
    std::array<std::uint32_t, kBricks + 1> first{};  // parts of brick b: first[b] up to first[b + 1]
    std::uint32_t groups = 0;
    std::array<std::vector<Link>, 3> links = {};  // to the next tile along each axis
    std::vector<bool> connected = {};             // by group, as of the last `connect`
    bool is_new = true;                           // groups were renewed since then
  };

  template <class Take>
  static void for_each_touching(const Tile& tile, std::size_t lower, const Tile& next, std::size_t upper,
                                std::size_t axis, Take&& take);
  static void find_groups(const BrickSet& cells, Tile& tile);
  void find_links(Tile& tile, std::size_t axis);
  [[nodiscard]] std::vector<std::vector<bool>> connected_with(std::span<const VoxelIndex> starts) const;

  VoxelTable<std::uint32_t> numbers_;  // of tiles, by their address in units of 64 cells
  std::vector<Tile> tiles_;
};

template <class Visit>
void ConnectedCells::connect(std::span<const VoxelIndex> starts, Visit&& visit) {
  std::vector<std::vector<bool>> connected = connected_with(starts);
  for (std::size_t number = 0; number < tiles_.size(); ++number) {
    Tile& tile = tiles_[number];
    if (!std::exchange(tile.is_new, false) && tile.connected == connected[number]) {
      continue;
    }
    tile.connected = std::move(connected[number]);
    for (std::size_t brick = 0; brick < kBricks; ++brick) {
      BrickPlane cells{};
      for (std::size_t part = tile.first[brick]; part < tile.first[brick + 1]; ++part) {
        for (std::size_t word = 0; word < Brick::kWords && tile.connected[tile.parts[part].group]; ++word) {
          cells[word] |= tile.parts[part].cells[word];
        }
      }
      const auto at = static_cast<std::int32_t>(brick);
      visit(Brick::first_cell(tile.address) + VoxelIndex{at & 7, at >> 3 & 7, at >> 6}, std::as_const(cells));
    }
  }
}

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/connected_cells.ipp>
#endif
