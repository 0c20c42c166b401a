// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "evaluation/exploration_peer.hpp"

namespace vantage::detail {

/// The parts of the frontier beyond the horizon, one for each cube that holds some: the part with the shortest route.
/// `parts` are nearest first; those within `horizon_m` by way are left out.
[[nodiscard]] std::vector<std::size_t> coarse_places(const std::vector<ViewedSite>& parts, double horizon_m,
                                                     double cube_m, const VoxelFrame& frame);

/// `tare-like`, see make_exploration_peer.
class TareLikePeer final : public ExplorationPeer {
 public:
  using ExplorationPeer::ExplorationPeer;

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override;
};

}  // namespace vantage::detail
