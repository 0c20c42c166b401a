// SPDX-License-Identifier: MIT
#pragma once

// Notay, "An aggregation-based algebraic multigrid method" (2010); the factor of over-correction after Braess 1995.
#include <vantage/field/impl/coarse_correction.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

#include <vantage/field/impl/block_graph.hpp>

namespace vantage::detail {

inline constexpr std::size_t kDirect = 100;  // the largest number of unknowns that are solved directly
inline constexpr int kSweepsOfMany = 20;     // on the last level, if it is larger than that

VANTAGE_INLINE CoarseCorrection::CoarseCorrection(const FineLevel& fine) : blocks_(fine) {
  graphs_.push_back(graph_of_blocks(fine, blocks_));
  while (graphs_.back().size > kDirect) {
    GraphLevel next = coarsen(*fine.team, graphs_.back());
    if (next.size == graphs_.back().size) {
      break;  // regions that touch only at sinks: each is one node already
    }
    graphs_.push_back(std::move(next));
  }
  const GraphLevel& last = graphs_.back();
  if (last.size > kDirect) {
    return;
  }
  const auto size = static_cast<Eigen::Index>(last.size);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < last.size; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    matrix(row, row) += static_cast<double>(last.leak[i]);
    last.for_each_edge(i, [&](const GraphLevel::Edge& edge) {
      matrix(row, row) += static_cast<double>(edge.conductance);
      matrix(row, static_cast<Eigen::Index>(edge.to)) -= static_cast<double>(edge.conductance);
    });
  }
  coarsest_ = matrix.llt().solve(Eigen::MatrixXd::Identity(size, size)).cast<float>();
}

// Solves the last level: exactly if its inverse exists, otherwise by relaxation from zero.
VANTAGE_INLINE void CoarseCorrection::solve_coarsest(ThreadTeam& team) {
  GraphLevel& last = graphs_.back();
  if (coarsest_.size() == 0) {
    std::fill(last.x.begin(), last.x.end(), 0.0F);
    for (int i = 0; i < 2 * kSweepsOfMany; ++i) {
      last.smooth(team, i < kSweepsOfMany);
    }
    return;
  }
  const auto size = static_cast<Eigen::Index>(last.size);
  Eigen::Map<Eigen::VectorXf>(last.x.data(), size).noalias() =
      coarsest_ * Eigen::Map<const Eigen::VectorXf>(last.right.data(), size);
}

// Two visits of the next level make a W-cycle. The last level is solved once.
VANTAGE_INLINE void CoarseCorrection::visit(ThreadTeam& team, std::size_t level) {
  if (level + 1 == graphs_.size()) {
    solve_coarsest(team);
    return;
  }
  cycle(team, level, true);
  cycle(team, level, false);
}

VANTAGE_INLINE void CoarseCorrection::cycle(ThreadTeam& team, std::size_t level, bool from_zero) {
  GraphLevel& graph = graphs_[level];
  GraphLevel& next = graphs_[level + 1];
  if (from_zero) {
    graph.smooth_from_zero(team);
  } else {
    graph.smooth(team, true);
  }
  graph.smooth(team, true);
  graph.restrict_to(team, next.right);
  visit(team, level + 1);
  graph.prolong(team, next.x);
  graph.smooth(team, false);
  graph.smooth(team, false);
}

VANTAGE_INLINE void CoarseCorrection::solve(const FineLevel& fine) {
  GraphLevel& next = graphs_.front();
  blocks_.descend(fine, next.right);
  visit(*fine.team, 0);
  blocks_.ascend(fine, next.x);
}

VANTAGE_INLINE std::size_t CoarseCorrection::memory_bytes() const {
  return std::accumulate(graphs_.begin(), graphs_.end(),
                         blocks_.memory_bytes() + static_cast<std::size_t>(coarsest_.size()) * sizeof(float),
                         [](std::size_t sum, const GraphLevel& graph) { return sum + graph.memory_bytes(); });
}

}  // namespace vantage::detail
