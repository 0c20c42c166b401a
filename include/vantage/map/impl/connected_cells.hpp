// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <utility>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick_set.hpp>
#include <vector>

namespace vantage::detail {

/// Which cells of a set are connected through faces, computed where it is asked for and kept until the set changes.
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
/// To find what is connected with some cells, only groups and links are visited: a few per tile, whatever its cells
/// are. A tile is asked for its cells when the search first reaches it, and again after a change in it. What the
/// search does not reach costs nothing.
class ConnectedCells {
 public:
  /// Writes the cells of the bricks of a tile (its address in units of 64 cells), with x fastest; all are empty
  /// before.
  using Fill = std::function<void(const VoxelIndex&, std::span<BrickPlane>)>;

  /// The position of a brick within its tile.
  [[nodiscard]] static std::size_t in_tile(const VoxelIndex& brick) {
    return static_cast<std::size_t>((brick.x & 7) | (brick.y & 7) << 3 | (brick.z & 7) << 6);
  }
  /// Tells that cells of a tile may have changed since the last `connect`.
  void changed(const VoxelIndex& tile);
  /// Finds the cells that are connected with any of `starts`; those outside the set are ignored. Calls `visit(brick
  /// address, const BrickPlane&)` with the connected cells of a brick, at least for each brick where they differ from
  /// those of the last call.
  template <class Visit>
  void connect(std::span<const VoxelIndex> starts, const Fill& fill, Visit&& visit);

 private:
  static constexpr std::size_t kBricks = 512;  // of a tile, numbered with x fastest
  using Number = std::uint32_t;
  struct Part {
    BrickPlane cells;
    std::uint32_t group;
  };
  // To the next tile along an axis.
  struct Links {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> groups = {};  // of this tile, of the next one
    std::size_t here = 0;                                              // versions of both tiles
    std::size_t there = 0;
  };
  struct Tile {
    VoxelIndex address;
    std::vector<Part> parts = {};                    // ordered by brick
    std::array<std::uint32_t, kBricks + 1> first{};  // parts of brick b: first[b] up to first[b + 1]
    std::uint32_t groups = 0;
    std::size_t version = 0;      // counts how often the groups were found
    std::array<bool, 6> opens{};  // whether a cell lies at this face, ordered as kFaceNeighbours
    std::array<Links, 3> links = {};
    std::vector<bool> connected = {};  // by group, as of the last `connect`; empty: none
    std::vector<bool> reached = {};    // by group, in this `connect`
    bool is_stale = true;
    bool is_new = false;  // groups were found since the last `connect`
  };
  struct Group {
    Number tile;
    std::uint32_t group;
  };

  template <class Take>
  static void for_each_touching(const Tile& tile, std::size_t lower, const Tile& next, std::size_t upper,
                                std::size_t axis, Take&& take);
  Number fresh_tile(const VoxelIndex& address, const Fill& fill);
  void find_groups(Tile& tile, const Fill& fill);
  static const Links& fresh_links(Tile& tile, const Tile& next, std::size_t axis);
  void reach(const Group& group);
  void search(std::span<const VoxelIndex> starts, const Fill& fill);

  VoxelTable<Number> numbers_;  // of tiles, by their address
  std::deque<Tile> tiles_;
  std::vector<Number> reached_;    // tiles with a connected group, in this `connect`
  std::vector<Number> connected_;  // as of the last one
  std::vector<Group> open_;
  std::vector<BrickPlane> filled_;
};

template <class Visit>
void ConnectedCells::connect(std::span<const VoxelIndex> starts, const Fill& fill, Visit&& visit) {
  search(starts, fill);
  std::vector<Number> either = reached_;
  for (const Number number : connected_) {
    if (tiles_[number].reached.empty()) {
      either.push_back(number);
    }
  }
  for (const Number number : either) {
    Tile& tile = tiles_[number];
    if (!std::exchange(tile.is_new, false) && tile.connected == tile.reached) {
      tile.reached.clear();
      continue;
    }
    const bool some = !tile.reached.empty();
    for (std::size_t brick = 0; brick < kBricks; ++brick) {
      BrickPlane cells{};
      for (std::size_t part = tile.first[brick]; some && part < tile.first[brick + 1]; ++part) {
        for (std::size_t word = 0; word < Brick::kWords && tile.reached[tile.parts[part].group]; ++word) {
          cells[word] |= tile.parts[part].cells[word];
        }
      }
      const auto at = static_cast<std::int32_t>(brick);
      visit(Brick::first_cell(tile.address) + VoxelIndex{at & 7, at >> 3 & 7, at >> 6}, std::as_const(cells));
    }
    tile.connected = std::exchange(tile.reached, {});
  }
  connected_ = std::exchange(reached_, {});
}

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/connected_cells.ipp>
#endif
