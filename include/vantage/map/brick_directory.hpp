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

/// Where the brick of an address is stored: a sparse array of brick numbers that grows with the map and has no preset
/// bounds. Tiles of 8 x 8 x 8 numbers hang in a hash table, so that walking from brick to brick mostly stays in a
/// tile.
class BrickDirectory {
 public:
  /// Where a brick is stored.
  using Number = std::uint32_t;
  /// The number of a brick that is not stored.
  static constexpr Number kNone = std::numeric_limits<Number>::max();

  /// The number stored for `brick`, or kNone.
  [[nodiscard]] Number find(const VoxelIndex& brick) const {
    const Number* const tile = tiles_.find(tile_of(brick));
    return tile == nullptr ? kNone : numbers_[*tile][offset_in_tile(brick)];
  }
  /// The place of the number of `brick`, kNone when new. Valid until the directory is copied or destroyed.
  [[nodiscard]] Number& place(const VoxelIndex& brick) {
    const Number tile = tiles_.place(tile_of(brick), static_cast<Number>(numbers_.size()));
    if (tile == numbers_.size()) {
      numbers_.emplace_back().fill(kNone);
    }
    return numbers_[tile][offset_in_tile(brick)];
  }
  /// Bytes held.
  [[nodiscard]] std::size_t memory_bytes() const {
    return numbers_.size() * (sizeof(Tile) + sizeof(void*)) + tiles_.memory_bytes();
  }

 private:
  using Tile = std::array<Number, 512>;

  static VoxelIndex tile_of(const VoxelIndex& brick) { return {brick.x >> 3, brick.y >> 3, brick.z >> 3}; }
  static std::size_t offset_in_tile(const VoxelIndex& brick) {
    return static_cast<std::size_t>((brick.x & 7) | (brick.y & 7) << 3 | (brick.z & 7) << 6);
  }

  VoxelTable<Number> tiles_;
  std::deque<Tile> numbers_;
};

}  // namespace vantage
