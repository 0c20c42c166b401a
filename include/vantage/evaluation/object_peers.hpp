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

/// What the peers of a planner of views of an object are told.
struct ObjectPeerSetup {
  std::shared_ptr<const Platform> platform;  ///< what carries the sensor; never null
  const ObjectScene* scene = nullptr;        ///< outlives the peer
  const Truth* truth = nullptr;              ///< outlives the peer: views are those admitted in it
  const SeenSurface* surface = nullptr;      ///< outlives the peer; for one who knows the truth
  std::size_t views = 8;                     ///< how many views are to be spread evenly, > 0
  std::uint64_t seed = 1;                    ///< of everything random
};

/// A planner to compare with: it looks at an object from the shells of a scene in an order that owes nothing to the
/// map, but for the way from view to view.
class ObjectPeer : public ExplorationPlanner {
 public:
  /// Where it would begin; none: wherever it is put.
  [[nodiscard]] virtual std::optional<Pose> first_view() = 0;
};

/// A peer by NAME:
/// - `evenly-spaced`: so many views evenly spread over the first shell, as far as it is admitted, along a spiral;
/// - `random-views`: views of the shells in an order drawn from the seed;
/// - `furthest-view`: always the view furthest from all that were taken;
/// - `oracle-greedy`: knows the truth, and takes the view that shows most of the surface not seen yet: a bound for
///   those who choose one view at a time.
/// Throws std::invalid_argument listing the names if there is no such peer, or naming what the setup lacks.
[[nodiscard]] std::unique_ptr<ObjectPeer> make_object_peer(std::string_view name, const ObjectPeerSetup& setup);
/// The names `make_object_peer` knows.
[[nodiscard]] std::span<const std::string_view> object_peer_names();

}  // namespace vantage
