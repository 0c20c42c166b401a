// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel_table.hpp>

namespace VANTAGE_EXPORT vantage {

/// A sparse index from brick addresses to brick numbers. It grows with the map and has no preset bounds. The numbers
/// are grouped into tiles of 8 x 8 x 8, and the tiles are stored in a hash table. Neighbouring bricks therefore
/// mostly share a tile.
class BrickDirectory {
 public:
  /// Index of a brick in the container that stores the bricks.
  using Number = std::uint32_t;
  /// Stands for a brick that is not stored.
  static constexpr Number kNone = std::numeric_limits<Number>::max();

  /// The number stored for `brick`, or kNone.
  [[nodiscard]] Number find(const VoxelIndex& brick) const {
    const Number* const tile = tiles_.find(tile_of(brick));
    return tile == nullptr ? kNone : numbers_[*tile][offset_in_tile(brick)];
  }
  /// A reference to the number of `brick`, to write to. It is kNone if the brick is new. Valid until the directory is
  /// copied over or destroyed.
  [[nodiscard]] Number& place(const VoxelIndex& brick) {
    const Number tile = tiles_.place(tile_of(brick), static_cast<Number>(numbers_.size()));
    if (tile == numbers_.size()) {
      numbers_.emplace_back().fill(kNone);
    }
    return numbers_[tile][offset_in_tile(brick)];
  }
  /// Memory in use, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const { return numbers_.size() * kBytesOfTile + tiles_.memory_bytes(); }
  /// What `memory_bytes` will be after `place(brick)`.
  [[nodiscard]] std::size_t memory_with(const VoxelIndex& brick) const {
    return tiles_.find(tile_of(brick)) != nullptr
               ? memory_bytes()
               : (numbers_.size() + 1) * kBytesOfTile + tiles_.memory_with_another();
  }

 private:
  using Tile = std::array<Number, 512>;
  static constexpr std::size_t kBytesOfTile = sizeof(Tile) + sizeof(void*);

  static VoxelIndex tile_of(const VoxelIndex& brick) { return {brick.x >> 3, brick.y >> 3, brick.z >> 3}; }
  static std::size_t offset_in_tile(const VoxelIndex& brick) {
    return static_cast<std::size_t>((brick.x & 7) | (brick.y & 7) << 3 | (brick.z & 7) << 6);
  }

  VoxelTable<Number> tiles_;
  std::deque<Tile> numbers_;
};

}  // namespace vantage
