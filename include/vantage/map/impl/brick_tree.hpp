// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage::detail {

/// A set of bricks that answers whether any brick overlaps a box. It is a tree whose nodes have 4 x 4 x 4 children,
/// one bit each. Memory grows with the number of bricks; a query visits few nodes.
class BrickTree {
 public:
  /// Adds a brick.
  void insert(const VoxelIndex& brick) {
    around_ = box_around(around_, {brick, brick + VoxelIndex{1, 1, 1}});
    VoxelIndex child = brick;
    for (VoxelTable<std::uint64_t>& level : levels_) {
      const VoxelIndex node{child.x >> 2, child.y >> 2, child.z >> 2};
      std::uint64_t& children = level.place(node);
      const bool is_new = children == 0;
      children |= bit_of(child);
      if (!is_new) {
        return;
      }
      child = node;
    }
  }
  /// Removes a brick.
  void erase(const VoxelIndex& brick) {
    VoxelIndex child = brick;
    for (VoxelTable<std::uint64_t>& level : levels_) {
      const VoxelIndex node{child.x >> 2, child.y >> 2, child.z >> 2};
      std::uint64_t* const children = level.find(node);
      if (children == nullptr) {
        return;
      }
      *children &= ~bit_of(child);
      if (*children != 0) {
        return;
      }
      child = node;
    }
  }
  /// Removes all bricks.
  void clear() {
    for (VoxelTable<std::uint64_t>& level : levels_) {
      level.clear();
    }
    around_ = {};
  }

  /// Whether any brick of the set overlaps this box of cells.
  [[nodiscard]] bool touches(const VoxelBox& cells) const {
    const VoxelBox bricks = box_overlap(Brick::over(cells), around_);
    if (bricks.empty()) {
      return false;
    }
    // Find the lowest level at which the box spans at most two nodes along each axis.
    std::size_t level = 0;
    VoxelBox nodes = parents(bricks);
    while (std::max({nodes.hi.x - nodes.lo.x, nodes.hi.y - nodes.lo.y, nodes.hi.z - nodes.lo.z}) > 2) {
      nodes = parents(nodes);
      ++level;
    }
    for (std::int32_t z = nodes.lo.z; z < nodes.hi.z; ++z) {
      for (std::int32_t y = nodes.lo.y; y < nodes.hi.y; ++y) {
        for (std::int32_t x = nodes.lo.x; x < nodes.hi.x; ++x) {
          if (any_below(level, {x, y, z}, bricks)) {
            return true;
          }
        }
      }
    }
    return false;
  }

 private:
  // The bit of a child in the mask of its parent.
  static std::uint64_t bit_of(const VoxelIndex& child) {
    return std::uint64_t{1} << ((child.x & 3) | (child.y & 3) << 2 | (child.z & 3) << 4);
  }
  static VoxelBox parents(const VoxelBox& box) {
    const auto up = [](std::int32_t i) { return i >> 2; };
    return {{up(box.lo.x), up(box.lo.y), up(box.lo.z)},
            {up(box.hi.x - 1) + 1, up(box.hi.y - 1) + 1, up(box.hi.z - 1) + 1}};
  }
  // Bit mask of the children of a node that lie in a box.
  static std::uint64_t children_in(const VoxelIndex& node, const VoxelBox& box) {
    const auto along = [](std::int32_t first, std::int32_t lo, std::int32_t hi) {
      const std::int32_t from = std::clamp(lo - first, 0, 4);
      const std::int32_t to = std::clamp(hi - first, from, 4);
      return (1U << static_cast<unsigned>(to)) - (1U << static_cast<unsigned>(from));  // a mask of four bits
    };
    constexpr std::array<std::uint64_t, 4> kRow{0x1, 0x10, 0x100, 0x1000};
    const std::uint64_t x = along(node.x * 4, box.lo.x, box.hi.x);
    const std::uint32_t y = along(node.y * 4, box.lo.y, box.hi.y);
    const std::uint32_t z = along(node.z * 4, box.lo.z, box.hi.z);
    std::uint64_t layer = 0;
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      layer |= (y >> i & 1U) != 0 ? x * kRow[i] : 0;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      all |= (z >> i & 1U) != 0 ? layer << 16U * i : 0;
    }
    return all;
  }
  [[nodiscard]] bool any_below(std::size_t level, const VoxelIndex& node, const VoxelBox& bricks) const {
    const std::uint64_t* const children = levels_[level].find(node);
    if (children == nullptr) {
      return false;
    }
    const auto shift = static_cast<std::int32_t>(2 * level);
    const std::int32_t rest = (1 << shift) - 1;
    const VoxelBox touched{
        {bricks.lo.x >> shift, bricks.lo.y >> shift, bricks.lo.z >> shift},
        {((bricks.hi.x - 1) >> shift) + 1, ((bricks.hi.y - 1) >> shift) + 1, ((bricks.hi.z - 1) >> shift) + 1}};
    std::uint64_t left = *children & children_in(node, touched);
    if (left == 0 || level == 0) {
      return left != 0;
    }
    const VoxelBox whole{
        {(bricks.lo.x + rest) >> shift, (bricks.lo.y + rest) >> shift, (bricks.lo.z + rest) >> shift},
        {bricks.hi.x >> shift, bricks.hi.y >> shift, bricks.hi.z >> shift}};
    if ((left & children_in(node, whole)) != 0) {
      return true;
    }
    for (; left != 0; left &= left - 1) {
      const int bit = std::countr_zero(left);
      if (any_below(level - 1, {node.x * 4 + (bit & 3), node.y * 4 + (bit >> 2 & 3), node.z * 4 + (bit >> 4)},
                    bricks)) {
        return true;
      }
    }
    return false;
  }

  VoxelBox around_;  // contains all bricks
  // Enough levels for every address. Nodes of level i + 1 contain nodes of level i.
  std::array<VoxelTable<std::uint64_t>, 15> levels_;
};

}  // namespace vantage::detail
