// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/block_graph.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace vantage::detail {

// A cube of 2 x 2 x 2 blocks. Bits 0, 1, 2 of a block's number stand for x, y, z. Also stores the position of the
// first block in its brick.
struct Octet {
  std::size_t first;
  VoxelIndex in_brick;

  explicit Octet(std::size_t number)
      : first(number / 8 * 64 + number / 4 % 2 * 16 + number % 4 * 2),
        in_brick{static_cast<std::int32_t>(number % 4), static_cast<std::int32_t>(number / 4 % 2),
                 static_cast<std::int32_t>(number / 8)} {}
  [[nodiscard]] std::size_t block(std::size_t i) const {
    return first + (i & 1U) + (i >> 1U & 1U) * 8 + (i >> 2U) * 32;
  }
};

// The blocks of an octet that are connected to its block `seed`.
inline std::uint32_t piece_of(const std::uint32_t* packed, const Octet& octet, std::size_t seed) {
  std::uint32_t piece = 1U << seed;
  std::uint32_t todo = piece;
  while (todo != 0) {
    const auto i = static_cast<std::size_t>(std::countr_zero(todo));
    todo &= todo - 1;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      // the face towards the neighbour in the octet
      const std::uint32_t side = 2 * axis + ((i >> axis & 1U) == 0 ? 1U : 0U);
      const std::uint32_t other = 1U << (i ^ (1U << axis));
      if ((packed[octet.block(i)] >> (3U * side) & 7U) != 0 && (piece & other) == 0) {
        piece |= other;
        todo |= other;
      }
    }
  }
  return piece;
}

// The pieces found in the bricks of a share, by parity.
using BrickPieces = std::array<std::vector<VoxelIndex>, 2>;
inline constexpr std::uint32_t kOdd = 0x80000000U;  // flag in the number of a piece with odd parity, within its share

inline void find_brick_pieces(const FineLevel& fine, std::size_t brick, std::uint32_t* node, BrickPieces& pieces) {
  const std::uint32_t* packed = fine.blocks.data() + brick * kBrickBlocks;
  const VoxelIndex& address = fine.address[brick];
  for (std::size_t number = 0; number < 16; ++number) {
    const Octet octet(number);
    for (std::size_t i = 0; i < 8; ++i) {
      if (packed[octet.block(i)] == 0 || node[octet.block(i)] != kNoNode) {
        continue;
      }
      const VoxelIndex at = VoxelIndex{address.x * 4, address.y * 2, address.z * 2} + octet.in_brick;
      std::vector<VoxelIndex>& same = pieces[is_even(at) ? 0 : 1];
      const std::uint32_t own = static_cast<std::uint32_t>(same.size()) | (is_even(at) ? 0U : kOdd);
      for (std::uint32_t piece = piece_of(packed, octet, i); piece != 0; piece &= piece - 1) {
        node[octet.block(static_cast<std::size_t>(std::countr_zero(piece)))] = own;
      }
      same.push_back(at);
    }
  }
}

// Global index of the block adjacent to `block` on a side.
inline std::size_t block_beside(const FineLevel& fine, std::size_t brick, std::size_t block, std::size_t side) {
  static constexpr std::array<std::size_t, 3> kStep{1, 8, 32};
  static constexpr std::array<std::size_t, 3> kCount{8, 4, 4};
  const std::size_t step = kStep[side / 2];
  const std::size_t last = kCount[side / 2] - 1;
  const std::size_t place = block / step % kCount[side / 2];
  if (side % 2 == 0) {
    return place > 0 ? brick * kBrickBlocks + block - step
                     : fine.links[brick][side] * kBrickBlocks + block + last * step;
  }
  return place < last ? brick * kBrickBlocks + block + step
                      : fine.links[brick][side] * kBrickBlocks + block - last * step;
}

// Writes the edges of the nodes of a brick.
inline void write_brick_edges(const FineLevel& fine, const AlignedVector<std::uint32_t>& node, std::size_t brick,
                              EdgeWriter& writer) {
  for (std::size_t number = 0; number < 16; ++number) {
    const Octet octet(number);
    std::uint32_t todo = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      todo |= fine.blocks[brick * kBrickBlocks + octet.block(i)] != 0 ? 1U << i : 0U;
    }
    while (todo != 0) {
      const std::uint32_t own =
          node[brick * kBrickBlocks + octet.block(static_cast<std::size_t>(std::countr_zero(todo)))];
      for (std::uint32_t left = todo; left != 0; left &= left - 1) {
        const std::size_t block = octet.block(static_cast<std::size_t>(std::countr_zero(left)));
        if (node[brick * kBrickBlocks + block] != own) {
          continue;
        }
        todo &= ~(left & (0U - left));
        const std::uint32_t packed = fine.blocks[brick * kBrickBlocks + block];
        std::uint32_t to_sinks = packed >> 18U;  // twice the conductance to sinks
        for (std::uint32_t side = 0; side < 6; ++side) {
          const std::uint32_t faces = packed >> (3U * side) & 7U;
          to_sinks -= faces;
          if (const std::uint32_t other = faces != 0 ? node[block_beside(fine, brick, block, side)] : own;
              other != own) {
            writer.join(other, kOverCorrection * 0.5F * static_cast<float>(faces));
          }
        }
        writer.leak(kOverCorrection * 0.5F * static_cast<float>(to_sinks));
      }
      writer.write(own);
    }
  }
}

VANTAGE_INLINE GraphLevel graph_of_blocks(const FineLevel& fine, BlockLevel& blocks) {
  blocks.node.resize(fine.brick_count * kBrickBlocks);
  std::vector<BrickPieces> found(fine.shares.size());
  fine.team->run([&](std::size_t i) {
    for (std::size_t b = fine.shares[i].begin; b < fine.shares[i].end; ++b) {
      std::uint32_t* node = blocks.node.data() + b * kBrickBlocks;
      std::fill_n(node, kBrickBlocks, kNoNode);
      find_brick_pieces(fine, b, node, found[i]);
    }
  });
  std::vector<std::array<std::size_t, 2>> first(fine.shares.size());
  std::array<std::size_t, 2> end{};
  for (const std::size_t parity : {0U, 1U}) {
    end[parity] = end[0];
    for (std::size_t i = 0; i < found.size(); ++i) {
      first[i][parity] = end[parity];
      end[parity] += found[i][parity].size();
    }
  }
  GraphLevel graph(end[1], end[0]);
  std::fill_n(blocks.node.data(), kBrickBlocks, static_cast<std::uint32_t>(graph.size));
  fine.team->run([&](std::size_t i) {
    for (const std::size_t parity : {0U, 1U}) {
      std::copy(found[i][parity].begin(), found[i][parity].end(), graph.at.data() + first[i][parity]);
    }
    for (std::size_t n = fine.shares[i].begin * kBrickBlocks; n < fine.shares[i].end * kBrickBlocks; ++n) {
      const std::uint32_t own = blocks.node[n];
      blocks.node[n] =
          static_cast<std::uint32_t>(own == kNoNode ? graph.size : first[i][own >= kOdd ? 1U : 0U] + (own & ~kOdd));
    }
  });
  std::vector<EdgeWriter> writers(fine.shares.size(), EdgeWriter(graph));
  fine.team->run([&](std::size_t i) {
    for (std::size_t b = fine.shares[i].begin; b < fine.shares[i].end; ++b) {
      write_brick_edges(fine, blocks.node, b, writers[i]);
    }
  });
  EdgeWriter::finish(graph, writers);
  return graph;
}

}  // namespace vantage::detail
