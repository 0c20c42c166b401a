// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "evaluation/fuel_like.hpp"
#include "evaluation/zones.hpp"

namespace vantage::detail {

/// `falcon-like`, see make_exploration_peer.
class FalconLikePeer final : public RefiningPeer {
 public:
  using RefiningPeer::RefiningPeer;

 private:
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;
};

/// The order in which a path from `start` covers these zones, those that have a way from it.
[[nodiscard]] std::vector<std::size_t> coverage_path(const Zones& zones, std::size_t start,
                                                     std::vector<std::size_t> to_cover);

}  // namespace vantage::detail
