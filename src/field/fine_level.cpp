// SPDX-License-Identifier: MIT
#include "field/fine_level.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace vantage::detail {
namespace {

// A thread with fewer of them waits for the others most of the time.
constexpr std::size_t kFewestBricks = 96;

using Rows = std::array<std::uint16_t, kBrickRows>;

// Every other bit of a row, from bit 0: eight bits.
std::uint32_t every_other(std::uint32_t row) {
  row &= 0x5555U;
  row = (row | row >> 1U) & 0x3333U;
  row = (row | row >> 2U) & 0x0F0FU;
  return (row | row >> 4U) & 0x00FFU;
}

// Bit k as 0 or 1 in byte k.
std::uint64_t bytes_of_bits(std::uint32_t bits) {
  const std::uint64_t picked = (bits * 0x0101010101010101ULL) & 0x8040201008040201ULL;
  return (picked + 0x00406070787C7E7FULL) >> 7U & 0x0101010101010101ULL;
}

// For each block of a pair of rows, how many of its two cells have their bit set: a byte per block.
std::uint64_t pairs(std::uint32_t row) {
  return bytes_of_bits(every_other(row)) + bytes_of_bits(every_other(row >> 1U));
}

// The six masks of one row: bit x is set if the neighbour of cell x on that side is in `planes`.
class Neighbourhood {
 public:
  Neighbourhood(const std::vector<LaplaceDomain::Brick>& bricks, std::size_t brick,
                const std::array<std::uint32_t, 6>& links, Rows LaplaceDomain::Brick::*plane)
      : own_(bricks[brick].*plane) {
    static constexpr Rows kNothing{};
    for (std::size_t face = 0; face < 6; ++face) {
      side_[face] = links[face] == LaplaceDomain::kNone ? &kNothing : &(bricks[links[face]].*plane);
    }
  }
  [[nodiscard]] std::array<std::uint32_t, 6> at(std::size_t row) const {
    const std::uint32_t own = own_[row];
    const std::size_t y = row % 8;
    return {(own << 1U | (*side_[0])[row] >> 15U) & 0xFFFFU,
            (own >> 1U | static_cast<std::uint32_t>((*side_[1])[row]) << 15U) & 0xFFFFU,
            y > 0 ? own_[row - 1] : (*side_[2])[row + 7],
            y < 7 ? own_[row + 1] : (*side_[3])[row - 7],
            row >= 8 ? own_[row - 8] : (*side_[4])[row + 56],
            row < 56 ? own_[row + 8] : (*side_[5])[row - 56]};
  }

 private:
  const Rows& own_;
  std::array<const Rows*, 6> side_{};
};

// Bit k as bit 4 k.
std::uint32_t nibbles_of_bits(std::uint32_t bits) {
  bits = (bits | bits << 12U) & 0x000F000FU;
  bits = (bits | bits << 6U) & 0x03030303U;
  return (bits | bits << 3U) & 0x11111111U;
}

// Sets what is known of the faces of one row, by adding six one-bit numbers per cell.
void write_degrees(FineLevel& level, std::size_t brick, std::size_t row, std::uint32_t interior,
                   const std::array<std::uint32_t, 6>& open, const std::array<std::uint32_t, 6>& sinks) {
  std::array<std::uint32_t, 3> digit{};
  std::uint32_t beside = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    const std::uint32_t carry = digit[0] & open[face];
    digit[0] ^= open[face];
    digit[2] ^= digit[1] & carry;
    digit[1] ^= carry;
    beside |= sinks[face];
  }
  for (const std::size_t colour : {kRed, kBlack}) {
    const auto shift =
        static_cast<std::uint32_t>((row ^ row >> 3U ^ colour) & 1U);  // x of the first cell of the colour
    const auto half = [&](std::uint32_t bits) { return every_other((bits & interior) >> shift); };
    level.faces[colour][brick * kBrickRows + row] =
        nibbles_of_bits(half(digit[0])) | nibbles_of_bits(half(digit[1])) << 1U |
        nibbles_of_bits(half(digit[2])) << 2U | nibbles_of_bits(half(beside)) << 3U;
  }
}

// Adds what one row of cells contributes to its row of blocks: faces open between two unknowns of different blocks,
// per side, and faces to sinks.
void add_to_blocks(std::array<std::uint64_t, 7>& faces, std::size_t row, std::uint32_t interior,
                   const std::array<std::uint32_t, 6>& unknown, const std::array<std::uint32_t, 6>& sinks) {
  faces[0] += bytes_of_bits(every_other(interior & unknown[0]));
  faces[1] += bytes_of_bits(every_other((interior & unknown[1]) >> 1U));
  const std::size_t y_side = 2 + row % 2;
  const std::size_t z_side = 4 + row / 8 % 2;
  faces[y_side] += pairs(interior & unknown[y_side]);
  faces[z_side] += pairs(interior & unknown[z_side]);
  for (const std::uint32_t sink : sinks) {
    if (const std::uint32_t there = interior & sink; there != 0) {
      faces[6] += pairs(there);
    }
  }
}

// Returns how many unknowns the brick has.
std::uint32_t fill_brick(FineLevel& level, const std::vector<LaplaceDomain::Brick>& bricks, std::size_t b,
                         const std::array<std::uint32_t, 6>& links) {
  const Neighbourhood cells(bricks, b, links, &LaplaceDomain::Brick::cells);
  const Neighbourhood sinks(bricks, b, links, &LaplaceDomain::Brick::sinks);
  std::array<std::array<std::uint64_t, 7>, 16> blocks{};
  std::uint32_t unknowns = 0;
  for (std::size_t row = 0; row < kBrickRows; ++row) {
    const std::uint32_t interior = bricks[b].cells[row] & ~static_cast<std::uint32_t>(bricks[b].sinks[row]);
    if (interior == 0) {
      continue;
    }
    const std::array<std::uint32_t, 6> open = cells.at(row);
    const std::array<std::uint32_t, 6> sink = sinks.at(row);
    std::array<std::uint32_t, 6> unknown{};
    for (std::size_t face = 0; face < 6; ++face) {
      unknown[face] = open[face] & ~sink[face];
    }
    unknowns += static_cast<std::uint32_t>(std::popcount(interior));
    write_degrees(level, b + 1, row, interior, open, sink);
    add_to_blocks(blocks[row / 16 * 4 + row % 8 / 2], row, interior, unknown, sink);
  }
  for (std::size_t line = 0; line < 16; ++line) {
    for (std::size_t k = 0; k < 8; ++k) {
      std::uint32_t packed = 0;
      for (std::uint32_t side = 0; side < 7; ++side) {
        packed |= static_cast<std::uint32_t>(blocks[line][side] >> (8 * k) & 0xFFU) << (3U * side);
      }
      level.blocks[(b + 1) * kBrickBlocks + line * 8 + k] = packed;
    }
  }
  return unknowns;
}

// Equal parts for all threads; needs the links.
void share_bricks(FineLevel& level) {
  level.shares.resize(level.team->size());
  level.passes.assign(level.brick_count, 3);
  for (std::size_t i = 0; i < level.shares.size(); ++i) {
    BrickShare& share = level.shares[i];
    share.begin = 1 + (level.brick_count - 1) * i / level.shares.size();
    share.end = 1 + (level.brick_count - 1) * (i + 1) / level.shares.size();
    for (std::size_t b = share.begin; b < share.end; ++b) {
      for (const std::uint32_t link : level.links[b]) {
        if (link != 0 && (link < share.begin || link >= share.end)) {
          level.passes[b] = 1;
        }
      }
      if (level.passes[b] == 1) {
        share.late_second.push_back(static_cast<std::uint32_t>(b));
      }
    }
  }
  for (BrickShare& share : level.shares) {
    for (std::size_t b = share.begin; b < share.end; ++b) {
      const auto is_late = [&](std::uint32_t link) { return link != 0 && level.passes[link] == 1; };
      if (level.passes[b] == 3 && std::any_of(level.links[b].begin(), level.links[b].end(), is_late)) {
        level.passes[b] = 2;
      }
      if (level.passes[b] < 3) {
        share.late_third.push_back(static_cast<std::uint32_t>(b));
      }
    }
  }
}

}  // namespace

FineLevel make_fine_level(const LaplaceDomain& domain, std::size_t threads) {
  const std::vector<LaplaceDomain::Brick>& bricks = domain.bricks();
  FineLevel level;
  level.brick_count = bricks.size() + 1;
  level.team = std::make_unique<ThreadTeam>(std::clamp<std::size_t>(bricks.size() / kFewestBricks, 1, threads));
  level.links.assign(level.brick_count, {});
  level.address.assign(level.brick_count, {});
  level.ready.assign(level.brick_count, 0);
  const std::vector<std::array<std::uint32_t, 6>> links = domain.neighbours();
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    level.address[b + 1] = bricks[b].address;
    level.ready[b + 1] = static_cast<std::uint32_t>(b + 1);
    for (std::size_t face = 0; face < 6; ++face) {
      level.links[b + 1][face] = links[b][face] == LaplaceDomain::kNone ? 0 : links[b][face] + 1;
      level.ready[b + 1] = std::max(level.ready[b + 1], level.links[b + 1][face]);
    }
  }
  share_bricks(level);
  clear(level, level.faces[kRed], kBrickRows);
  clear(level, level.faces[kBlack], kBrickRows);
  clear(level, level.blocks, kBrickBlocks);
  std::vector<std::uint32_t> unknowns(level.brick_count, 0);
  for_bricks(level, [&](std::size_t b) { unknowns[b] = fill_brick(level, bricks, b - 1, links[b - 1]); });
  level.unknowns = std::accumulate(unknowns.begin(), unknowns.end(), std::size_t{0});
  return level;
}

std::size_t FineLevel::memory_bytes() const {
  return bytes_of(address) + bytes_of(links) + bytes_of(ready) + bytes_of(passes) + bytes_of(faces[0]) +
         bytes_of(faces[1]) + bytes_of(blocks);
}

}  // namespace vantage::detail
