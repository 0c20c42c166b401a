// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/triangle_mesh.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Where the object stands, and the views around it.
struct ObjectSceneOptions {
  std::string name = "object";  ///< World::name
  bool table = false;           ///< true: it stands in the world `table`; false: it hangs in free space
  std::optional<Box> object_box = std::nullopt;  ///< box to reconstruct, metres; none: the object with 3 cm around it
  std::vector<double> radii_m =
      {};  ///< radii of the shells of views, metres; empty: one from which the whole box is in view
  double resolution_m = 0.02;   ///< edge of a cell of the map, metres, > 0
  double body_radius_m = 0.05;  ///< radius of the robot, metres: there is room for it on the shells
  /// Position of the sensor at the start in the room of the table, world frame, metres; none: on the first shell.
  std::optional<Eigen::Vector3d> start = std::nullopt;
};

/// Height of the table top in the world `table`, metres.
inline constexpr double kTableTopM = 0.427277;

/// An object in its world.
struct ObjectScene {
  World world;                  ///< the object and what it stands on
  Box box;                      ///< box of the object, unknown at first, metres
  std::vector<double> radii_m;  ///< radii of the shells of views about the middle of the box, metres
};

/// Puts an object, given at its place in the world, into its world. The region is a cube that holds the shells; in
/// the world `table` it also holds the start, and is cut off at the walls of the room. If no radius is given there is
/// one shell, of `fitting_radius_m`, on the table of at most 1.5 m (Vasquez-Gomez et al. 2013).
[[nodiscard]] ObjectScene object_scene(const TriangleMesh& object, const RangeSensor& sensor,
                                       const ObjectSceneOptions& options);

/// A first view of the object: drawn from the seed among those admitted views of the first shell in which the box
/// appears at least 0.9 times as large as in the best of them; what the table hides of it does not count. Throws
/// std::invalid_argument if no view is admitted.
[[nodiscard]] Pose draw_first_view(const ObjectScene& scene, const Truth& truth, const Platform& platform,
                                   std::uint64_t seed);

/// Settings of the planner `next-best-view` for a scene (make_planner): the box and the shells.
[[nodiscard]] Settings planner_settings(const ObjectScene& scene);

}  // namespace vantage
