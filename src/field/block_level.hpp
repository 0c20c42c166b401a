// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "field/fine_level.hpp"

namespace vantage::detail {

/// The first coarse level: one unknown per 2 x 2 x 2 cells, in the bricks of the fine level. Between two blocks the
/// conductance is half the number of open faces between their cells, half because their centres lie twice as far
/// apart; to sinks it is the number of faces. A block is packed in 32 bits: six counts of 3 bits in the order of
/// kFaceNeighbours, then twice the sum of its conductances.
///
/// A block may hold cells that are not joined within it; it is so rare for walls at least a cell thick that it does
/// not show in the number of iterations.
struct BlockLevel {
  AlignedVector<float> x;             ///< the correction
  AlignedVector<float> right;         ///< the right hand side
  AlignedVector<std::uint32_t> node;  ///< of the graph that comes next; one past its last where there is no block

  explicit BlockLevel(const FineLevel& fine);

  /// Two relaxations from 0, in each the rows of even y + z before the others, and the sums of the residual over the
  /// nodes of the next level; `sums` is one longer than there are nodes.
  void descend(const FineLevel& fine, AlignedVector<float>& sums);
  /// Adds the correction of the next level, its last entry 0; then two relaxations in the reverse order.
  void ascend(const FineLevel& fine, const AlignedVector<float>& correction);

  [[nodiscard]] std::size_t memory_bytes() const { return bytes_of(x) + bytes_of(right) + bytes_of(node); }

 private:
  void begin(const FineLevel& fine, std::size_t brick);
  void relax(const FineLevel& fine, std::size_t brick, bool even);
  void restrict_brick(const FineLevel& fine, std::size_t brick, AlignedVector<float>& sums) const;
};

}  // namespace vantage::detail
