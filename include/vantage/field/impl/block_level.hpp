// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <vantage/field/impl/fine_level.hpp>

namespace vantage::detail {

/// The first coarse level: one unknown per block of 2 x 2 x 2 cells, stored in the bricks of the fine level. The
/// conductance between two blocks is half the number of open faces between their cells; the half stands for the
/// double distance of their centres. The conductance to sinks is the number of faces. A block is packed into 32 bits:
/// six counts of 3 bits in the order of kFaceNeighbours, then twice the sum of its conductances.
///
/// A block may contain cells that are not connected inside it. If walls are at least one cell thick, this is so rare
/// that it does not affect the number of iterations.
struct BlockLevel {
  AlignedVector<float> x;             ///< the correction
  AlignedVector<float> right;         ///< the right hand side
  AlignedVector<std::uint32_t> node;  ///< node of each block in the next graph; number of nodes if there is no block

  explicit BlockLevel(const FineLevel& fine);

  /// Downward part of a cycle: two relaxations from 0, each with even y + z first, then restriction. `sums` receives
  /// the residual summed over the nodes of the next level; its size is the number of nodes plus 1.
  void descend(const FineLevel& fine, AlignedVector<float>& sums);
  /// Upward part of a cycle: adds the correction of the next level, whose last entry must be 0, then two relaxations
  /// in reverse order.
  void ascend(const FineLevel& fine, const AlignedVector<float>& correction);

  [[nodiscard]] std::size_t memory_bytes() const { return bytes_of(x) + bytes_of(right) + bytes_of(node); }

 private:
  void begin(const FineLevel& fine, std::size_t brick);
  void relax(const FineLevel& fine, std::size_t brick, bool even);
  void restrict_brick(const FineLevel& fine, std::size_t brick, AlignedVector<float>& sums) const;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/block_level.ipp>
#endif
