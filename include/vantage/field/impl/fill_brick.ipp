// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/fill_brick.hpp>

#include <array>
#include <cstring>

#include <vantage/field/impl/lanes.hpp>

namespace vantage::detail {

using Plane = std::array<std::uint16_t, kBrickRows>;
// The eight rows of one layer (z) of a brick: one bit per cell, or eight 4-bit numbers per row.
using Layer = Lanes<std::uint32_t>;

VANTAGE_ALWAYS_INLINE Layer layer_of(const Plane& plane, std::size_t z) {
  return __builtin_convertvector(load<std::uint16_t>(plane.data() + z * 8), Layer);
}

// Spreads the even bits of a row to eight 4-bit numbers.
VANTAGE_ALWAYS_INLINE Layer every_other(const Layer& rows) {
  Layer bits = rows & 0x5555U;
  bits = (bits | bits << 8U) & 0x00550055U;
  bits = (bits | bits << 4U) & 0x05050505U;
  return (bits | bits << 2U) & 0x11111111U;
}

// For each block, the number of its two cells in the row whose bit is set.
VANTAGE_ALWAYS_INLINE Layer pairs(const Layer& rows) { return every_other(rows) + every_other(rows >> 1U); }

// One bit plane of a brick and of its neighbours.
struct PlaneAround {
  const Plane* own;
  std::array<const Plane*, 6> side;

  PlaneAround(const std::vector<LaplaceDomain::Brick>& bricks, std::size_t brick,
              const std::array<std::uint32_t, 6>& links, Plane LaplaceDomain::Brick::*plane)
      : own(&(bricks[brick].*plane)) {
    static constexpr Plane kNothing{};
    for (std::size_t face = 0; face < 6; ++face) {
      side[face] = links[face] == LaplaceDomain::kNone ? &kNothing : &(bricks[links[face]].*plane);
    }
  }
  // Bit x of a row is set if the neighbour of cell x on that side is in the plane.
  [[nodiscard]] VANTAGE_ALWAYS_INLINE std::array<Layer, 6> neighbours(std::size_t z) const {
    const Layer here = layer_of(*own, z);
    return {(here << 1U | layer_of(*side[0], z) >> 15U) & 0xFFFFU,
            (here >> 1U | layer_of(*side[1], z) << 15U) & 0xFFFFU,
            shifted_up<std::uint32_t>(here, layer_of(*side[2], z)),
            shifted_down<std::uint32_t>(here, layer_of(*side[3], z)),
            z > 0 ? layer_of(*own, z - 1) : layer_of(*side[4], 7),
            z < 7 ? layer_of(*own, z + 1) : layer_of(*side[5], 0)};
  }
};

// What the cells of two layers contribute to their blocks, by row: the open faces between unknowns of different
// blocks per side, and the faces to sinks per layer.
struct BlockFaces {
  std::array<Layer, 6> open{};
  std::array<Layer, 2> sinks{};
};

struct FillBrick {
  PlaneAround cells;
  PlaneAround sinks;
  std::array<std::uint32_t*, 2> faces;
  std::uint32_t* blocks;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t z = 0; z < 8; z += 2) {
      BlockFaces sums;
      const bool lower = fill_layer(z, sums);
      const bool upper = fill_layer(z + 1, sums);
      if (lower || upper) {
        write_blocks(z / 2, sums);
      }
    }
  }

 private:
  [[nodiscard]] static bool is_empty(const Plane& plane, std::size_t z) {
    std::array<std::uint64_t, 2> words{};
    std::memcpy(words.data(), plane.data() + z * 8, sizeof words);
    return (words[0] | words[1]) == 0;
  }
  // Returns false if the layer has no cells.
  VANTAGE_ALWAYS_INLINE bool fill_layer(std::size_t z, BlockFaces& sums) const {
    if (is_empty(*cells.own, z)) {
      return false;
    }
    const Layer interior = layer_of(*cells.own, z) & ~layer_of(*sinks.own, z);
    const std::array<Layer, 6> open = cells.neighbours(z);
    const std::array<Layer, 6> sink = sinks.neighbours(z);
    write_faces(z, interior, open, sink);
    std::array<Layer, 6> unknown{};
    for (std::size_t side = 0; side < 6; ++side) {
      unknown[side] = interior & open[side] & ~sink[side];
      sums.sinks[z % 2] += pairs(interior & sink[side]);
    }
    sums.open[0] += every_other(unknown[0]);
    sums.open[1] += every_other(unknown[1] >> 1U);
    sums.open[2] += pairs(unknown[2]);
    sums.open[3] += pairs(unknown[3]);
    sums.open[4 + z % 2] += pairs(unknown[4 + z % 2]);
    return true;
  }
  // Counts the open faces by adding six one-bit numbers per cell.
  VANTAGE_ALWAYS_INLINE void write_faces(std::size_t z, const Layer& interior, const std::array<Layer, 6>& open,
                                         const std::array<Layer, 6>& sink) const {
    std::array<Layer, 3> digit{};
    Layer beside{};
    for (std::size_t side = 0; side < 6; ++side) {
      const Layer carry = digit[0] & open[side];
      digit[0] ^= open[side];
      digit[2] ^= digit[1] & carry;
      digit[1] ^= carry;
      beside |= sink[side];
    }
    const Layer row{0, 1, 2, 3, 4, 5, 6, 7};
    for (const std::size_t colour : {kRed, kBlack}) {
      const Layer first = (row ^ static_cast<std::uint32_t>(z ^ colour)) & 1U;  // x of the first cell of this colour
      const auto half = [&](const Layer& bits)
                            VANTAGE_ALWAYS_INLINE_LAMBDA { return every_other((bits & interior) >> first); };
      store<std::uint32_t>(faces[colour] + z * 8,
                           half(digit[0]) | half(digit[1]) << 1U | half(digit[2]) << 2U | half(beside) << 3U);
    }
  }
  VANTAGE_ALWAYS_INLINE void write_blocks(std::size_t pair, const BlockFaces& sums) const {
    std::array<std::array<std::uint32_t, 8>, 8> by_row{};
    for (std::size_t side = 0; side < 6; ++side) {
      store<std::uint32_t>(by_row[side].data(), sums.open[side]);
    }
    store<std::uint32_t>(by_row[6].data(), sums.sinks[0]);
    store<std::uint32_t>(by_row[7].data(), sums.sinks[1]);
    const auto wide = [](std::uint32_t numbers) VANTAGE_ALWAYS_INLINE_LAMBDA {
      const Layer shift{0, 4, 8, 12, 16, 20, 24, 28};
      return all(numbers) >> shift & 15U;
    };
    for (std::size_t y = 0; y < 8; y += 2) {
      Layer packed{};
      Layer twice{};
      for (std::uint32_t side = 0; side < 6; ++side) {
        // Along y, only the row at that side of the block has such faces. Along x and z both rows have them, at most
        // four together.
        const std::uint32_t numbers = side == 2   ? by_row[2][y]
                                      : side == 3 ? by_row[3][y + 1]
                                                  : by_row[side][y] + by_row[side][y + 1];
        const Layer count = wide(numbers);
        packed |= count << (3U * side);
        twice += count;
      }
      for (const std::size_t layer : {6U, 7U}) {
        if ((by_row[layer][y] | by_row[layer][y + 1]) != 0) {
          twice += 2U * (wide(by_row[layer][y]) + wide(by_row[layer][y + 1]));
        }
      }
      store<std::uint32_t>(blocks + (pair * 4 + y / 2) * 8, packed | twice << 18U);
    }
  }
};

VANTAGE_INLINE void fill_brick(FineLevel& level, const std::vector<LaplaceDomain::Brick>& bricks, std::size_t b,
                               const std::array<std::uint32_t, 6>& links) {
  const std::size_t to = b + 1;
  compiled_for(level.set,
               FillBrick{PlaneAround(bricks, b, links, &LaplaceDomain::Brick::cells),
                         PlaneAround(bricks, b, links, &LaplaceDomain::Brick::sinks),
                         {level.faces[kRed].data() + to * kBrickRows, level.faces[kBlack].data() + to * kBrickRows},
                         level.blocks.data() + to * kBrickBlocks});
}

}  // namespace vantage::detail
