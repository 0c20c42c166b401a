// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "evaluation/fuel_like.hpp"
#include "evaluation/zones.hpp"

namespace vantage::detail {

/// `falcon-like`, see make_exploration_peer.
class FalconLikePeer final : public RefiningPeer {
 public:
  using RefiningPeer::RefiningPeer;

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override;
};

/// The order in which a path covers zones. `to_cover`: zones, and the way from here to each, metres; those with an
/// infinite one are left out.
[[nodiscard]] std::vector<std::size_t> coverage_path(const Zones& zones,
                                                     const std::map<std::size_t, double>& to_cover);

}  // namespace vantage::detail
