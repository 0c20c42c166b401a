// SPDX-License-Identifier: MIT
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/evaluation/exploration_peers.hpp>

#include "evaluation/aep_like.hpp"
#include "evaluation/distance_advantage.hpp"
#include "evaluation/falcon_like.hpp"
#include "evaluation/fuel_like.hpp"
#include "evaluation/rh_nbv.hpp"
#include "evaluation/tare_like.hpp"

namespace vantage {
namespace {

using MakePeer = std::unique_ptr<ExplorationPlanner> (*)(std::string_view, const PlannerSetup&);

template <class Peer>
std::unique_ptr<ExplorationPlanner> made_peer(std::string_view name, const PlannerSetup& setup) {
  return std::make_unique<Peer>(name, setup);
}

constexpr std::array<std::string_view, 6> kExplorers{"distance-advantage", "fuel-like", "rh-nbv",
                                                     "aep-like",           "tare-like", "falcon-like"};
constexpr std::array<MakePeer, kExplorers.size()> kPeerMakers{
    made_peer<detail::DistanceAdvantagePeer>, made_peer<detail::FuelLikePeer>, made_peer<detail::RhNbvPeer>,
    made_peer<detail::AepLikePeer>,           made_peer<detail::TareLikePeer>, made_peer<detail::FalconLikePeer>};

}  // namespace

std::unique_ptr<ExplorationPlanner> make_exploration_peer(std::string_view name, const PlannerSetup& setup) {
  std::string names;
  for (std::size_t i = 0; i < kExplorers.size(); ++i) {
    if (kExplorers[i] == name) {
      return kPeerMakers[i](kExplorers[i], setup);
    }
    names += (names.empty() ? "" : ", ") + std::string(kExplorers[i]);
  }
  throw std::invalid_argument("there is no planner '" + std::string(name) + "' to compare with; there are: " + names);
}

std::span<const std::string_view> exploration_peer_names() { return kExplorers; }

}  // namespace vantage
