// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/object_scene.hpp>
#include <vantage/sim/seen_surface.hpp>
#include <vantage/sim/truth.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Inputs of a peer, a planner to compare ObjectPlanner with. No pointer may be null.
struct ObjectPeerSetup {
  std::shared_ptr<const Platform> platform;  ///< the body that carries the sensor
  const ObjectScene* scene = nullptr;        ///< the scene; must outlive the peer
  const Truth* truth = nullptr;              ///< ground truth; must outlive the peer; views are admitted in it
  const SeenSurface* surface = nullptr;      ///< what has been seen; must outlive the peer; for `oracle-greedy`
  std::size_t views = 8;                     ///< number of views of `evenly-spaced`, > 0
  std::uint64_t seed = 1;                    ///< seed of everything random: the turn of the spiral, the random order
};

/// A planner to compare with. It takes views from the shells of a scene in an order that does not depend on the
/// map; only the path from view to view does.
class ObjectPeer : public ExplorationPlanner {
 public:
  /// The first view of the peer's order (world_from_sensor); none if the order does not determine it.
  [[nodiscard]] virtual std::optional<Pose> first_view() = 0;
};

/// Makes a peer by NAME:
/// - `evenly-spaced`: `views` views spread evenly over the admitted part of the first shell, in the order of a
///   spiral;
/// - `random-views`: views of the shells in a random order;
/// - `furthest-view`: always the view that is furthest from the nearest view taken;
/// - `oracle-greedy`: always the view that shows most of the true surface not yet seen. It knows the ground truth;
///   it is the best that a greedy choice can do.
///
/// Throws std::invalid_argument if there is no such peer, with the list of names, or if the setup lacks something.
[[nodiscard]] std::unique_ptr<ObjectPeer> make_object_peer(std::string_view name, const ObjectPeerSetup& setup);
/// The names `make_object_peer` knows.
[[nodiscard]] std::span<const std::string_view> object_peer_names();

}  // namespace vantage
