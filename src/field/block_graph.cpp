// SPDX-License-Identifier: MIT
#include "field/block_graph.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace vantage::detail {
namespace {

// Eight blocks, bit 0 of their number for x, 1 for y, 2 for z; where the first lies in its brick.
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

// The blocks of an octet joined to its block `seed`.
std::uint32_t piece_of(const std::uint32_t* packed, const Octet& octet, std::size_t seed) {
  std::uint32_t piece = 1U << seed;
  std::uint32_t todo = piece;
  while (todo != 0) {
    const auto i = static_cast<std::size_t>(std::countr_zero(todo));
    todo &= todo - 1;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t side = 2 * axis + ((i >> axis & 1U) == 0 ? 1U : 0U);  // the face towards the other one
      const std::uint32_t other = 1U << (i ^ (1U << axis));
      if ((packed[octet.block(i)] >> (3U * side) & 7U) != 0 && (piece & other) == 0) {
        piece |= other;
        todo |= other;
      }
    }
  }
  return piece;
}

// Renumbers so that nodes of even parity come first, the order kept otherwise.
std::vector<VoxelIndex> even_first(const std::vector<VoxelIndex>& at, std::vector<std::uint32_t>& node) {
  std::vector<std::uint32_t> number(at.size() + 1);
  std::vector<VoxelIndex> ordered;
  ordered.reserve(at.size());
  for (const std::int32_t parity : {0, 1}) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (((at[i].x ^ at[i].y ^ at[i].z) & 1) == parity) {
        number[i] = static_cast<std::uint32_t>(ordered.size());
        ordered.push_back(at[i]);
      }
    }
  }
  number.back() = static_cast<std::uint32_t>(at.size());
  for (std::uint32_t& one : node) {
    one = number[std::min<std::size_t>(one, at.size())];
  }
  return ordered;
}

std::vector<VoxelIndex> number_pieces(const FineLevel& fine, std::vector<std::uint32_t>& node) {
  std::vector<VoxelIndex> at;
  node.assign(fine.brick_count * kBrickBlocks, kNoNode);
  for (std::size_t brick = 1; brick < fine.brick_count; ++brick) {
    const std::uint32_t* packed = fine.blocks.data() + brick * kBrickBlocks;
    const VoxelIndex& address = fine.address[brick];
    for (std::size_t number = 0; number < 16; ++number) {
      const Octet octet(number);
      for (std::size_t i = 0; i < 8; ++i) {
        if (packed[octet.block(i)] == 0 || node[brick * kBrickBlocks + octet.block(i)] != kNoNode) {
          continue;
        }
        for (std::uint32_t piece = piece_of(packed, octet, i); piece != 0; piece &= piece - 1) {
          node[brick * kBrickBlocks + octet.block(static_cast<std::size_t>(std::countr_zero(piece)))] =
              static_cast<std::uint32_t>(at.size());
        }
        at.push_back(VoxelIndex{address.x * 4, address.y * 2, address.z * 2} + octet.in_brick);
      }
    }
  }
  return even_first(at, node);
}

// The block after `block` along an axis, in all bricks.
std::size_t block_after(const FineLevel& fine, std::size_t brick, std::size_t block, std::size_t axis) {
  static constexpr std::array<std::size_t, 3> kStep{1, 8, 32};
  static constexpr std::array<std::size_t, 3> kCount{8, 4, 4};
  if (block / kStep[axis] % kCount[axis] + 1 < kCount[axis]) {
    return brick * kBrickBlocks + block + kStep[axis];
  }
  return fine.links[brick][2 * axis + 1] * kBrickBlocks + block - (kCount[axis] - 1) * kStep[axis];
}

}  // namespace

GraphLevel graph_of_blocks(const FineLevel& fine, BlockLevel& blocks) {
  std::vector<VoxelIndex> at = number_pieces(fine, blocks.node);
  std::vector<float> leaks(at.size(), 0.0F);
  std::vector<GraphLevel::Join> joins;
  for (std::size_t brick = 1; brick < fine.brick_count; ++brick) {
    for (std::size_t block = 0; block < kBrickBlocks; ++block) {
      const std::uint32_t packed = fine.blocks[brick * kBrickBlocks + block];
      if (packed == 0) {
        continue;
      }
      const std::uint32_t own = blocks.node[brick * kBrickBlocks + block];
      leaks[own] += kOverCorrection * static_cast<float>(packed >> 18U);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t faces = packed >> (6 * axis + 3) & 7U;
        if (faces == 0) {
          continue;
        }
        if (const std::uint32_t other = blocks.node[block_after(fine, brick, block, axis)]; other != own) {
          joins.push_back({own, other, kOverCorrection * 0.5F * static_cast<float>(faces)});
        }
      }
    }
  }
  return {std::move(at), std::move(leaks), joins};
}

}  // namespace vantage::detail
