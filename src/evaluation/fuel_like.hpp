// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "evaluation/exploration_peer.hpp"

namespace vantage::detail {

/// What it costs to come from a view to another; from the number of views: from the start.
using LegCost = std::function<double(std::size_t from, std::size_t to)>;

/// The order of an open tour over some views from `start` that costs least. With `end`, the leg from the last one to
/// `end` counts too.
[[nodiscard]] std::vector<std::size_t> cheapest_order(const std::vector<std::size_t>& views, std::size_t start,
                                                      const LegCost& leg,
                                                      std::optional<std::size_t> end = std::nullopt);
/// One view of each layer, so that the way through them from `start` costs least (dynamic programming). With `end`,
/// the leg from the last one to `end` counts too. At least one layer, and none is empty.
[[nodiscard]] std::vector<std::size_t> cheapest_through(const std::vector<std::vector<std::size_t>>& layers,
                                                        std::size_t start, const LegCost& leg,
                                                        std::optional<std::size_t> end = std::nullopt);

/// Planners that choose among several views of each of the first parts of a tour.
class RefiningPeer : public ExplorationPeer {
 public:
  using ExplorationPeer::ExplorationPeer;

 protected:
  /// Samples views of the nearest parts; the others get one.
  void look_at(std::vector<ViewedSite>& parts, Plan& plan) const;
  /// Takes the best view of the first of `order`, given what comes after it.
  [[nodiscard]] ChosenView refined(const std::vector<ViewedSite>& parts, const std::vector<std::size_t>& order,
                                   const std::vector<double>& from_start);
};

/// `fuel-like`, see make_exploration_peer.
class FuelLikePeer final : public RefiningPeer {
 public:
  using RefiningPeer::RefiningPeer;

 private:
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;
};

}  // namespace vantage::detail
