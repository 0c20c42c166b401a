// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "evaluation/exploration_peer.hpp"

namespace vantage::detail {

/// For each place: the mean path length to it from all cells of the set, minus the path length from `start`, metres.
[[nodiscard]] std::vector<double> distance_advantages(const BlockWays& ways, const VoxelIndex& start,
                                                      const std::vector<VoxelIndex>& places);

/// `distance-advantage`, see make_exploration_peer.
class DistanceAdvantagePeer final : public ExplorationPeer {
 public:
  using ExplorationPeer::ExplorationPeer;

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override;
};

}  // namespace vantage::detail
