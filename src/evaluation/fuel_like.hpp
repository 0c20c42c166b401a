// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <vantage/view/impl/cover_tour.hpp>
#include "evaluation/exploration_peer.hpp"

namespace vantage::detail {

/// The order of an open tour over some views from `start` that costs least. With `end`, the leg from the last one to
/// `end` counts too.
[[nodiscard]] std::vector<std::size_t> cheapest_order(const std::vector<std::size_t>& views, std::size_t start,
                                                      const LegCost& leg,
                                                      std::optional<std::size_t> end = std::nullopt);

/// Planners that choose among several views of each of the first parts of a tour.
class RefiningPeer : public ExplorationPeer {
 public:
  using ExplorationPeer::ExplorationPeer;

 protected:
  /// Samples views of the nearest parts; the others get one.
  void look_at(const Situation& situation, std::vector<ViewedSite>& parts, PlanStatistics& statistics) const;
  /// Takes the best view of the first of `order`, given what comes after it.
  [[nodiscard]] Choice refined(const Situation& situation, const std::vector<ViewedSite>& parts,
                               const std::vector<std::size_t>& order, const std::vector<double>& from_start,
                               const PlanStatistics& so_far);
};

/// `fuel-like`, see make_exploration_peer.
class FuelLikePeer final : public RefiningPeer {
 public:
  using RefiningPeer::RefiningPeer;

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override;
};

}  // namespace vantage::detail
