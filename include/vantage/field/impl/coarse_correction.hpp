// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include <vantage/field/impl/block_level.hpp>
#include <vantage/field/impl/graph_level.hpp>

namespace vantage::detail {

/// All levels above the cells, and the multigrid cycle over them.
///
///     cells       red and black, in bricks       (FineLevel, solved by BrickSolver)
///       v
///     blocks      2 x 2 x 2 cells each           (BlockLevel, still in bricks)
///       v
///     nodes       connected pieces of 2 x 2 x 2 blocks, then of 2 x 2 x 2 such cubes, ... (GraphLevel)
///       v
///     last graph  at most 100 nodes: solved directly
///
/// W-cycles are used: with plain aggregation, V-cycles would need more iterations for every added level (Notay 2010).
/// The correction is a symmetric, positive definite function of the right hand side, as conjugate gradients require.
class CoarseCorrection {
 public:
  explicit CoarseCorrection(const FineLevel& fine);

  /// The right hand side of the blocks of a brick, to be written before `solve`.
  [[nodiscard]] float* right(std::size_t brick) { return blocks_.right.data() + brick * kBrickBlocks; }
  /// Solves approximately for the blocks.
  void solve(const FineLevel& fine);
  /// The correction of the blocks of a brick.
  [[nodiscard]] const float* correction(std::size_t brick) const { return blocks_.x.data() + brick * kBrickBlocks; }

  /// Number of levels above the cells.
  [[nodiscard]] std::size_t level_count() const { return 1 + graphs_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  void visit(ThreadTeam& team, std::size_t level);
  void cycle(ThreadTeam& team, std::size_t level, bool from_zero);
  void solve_coarsest(ThreadTeam& team);

  BlockLevel blocks_;
  std::vector<GraphLevel> graphs_;
  Eigen::MatrixXf coarsest_;  // inverse of the operator of the last graph; empty if that is too large
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/coarse_correction.ipp>
#endif
