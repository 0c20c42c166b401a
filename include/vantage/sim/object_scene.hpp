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

/// How an object is put before a sensor.
struct ObjectSceneOptions {
  std::string name = "object";                   ///< World::name
  bool table = false;                            ///< in the world `table`, else in free space
  std::optional<Box> object_box = std::nullopt;  ///< what is to be reconstructed; else 3 cm around the object
  std::vector<double> radii_m = {};  ///< of the shells of views; none: one from which all of the box is in view
  double resolution_m = 0.02;        ///< of the map, > 0
};

/// Top of the world `table`, metres.
inline constexpr double kTableTopM = 0.427277;

/// An object in the world in which it is looked at.
struct ObjectScene {
  World world;                  ///< the object and what it stands on
  Box box;                      ///< of the object, unknown at first
  std::vector<double> radii_m;  ///< of shells of views about the middle of the box
};

/// Puts an object, which lies where it is to be, into its world. Where no radius is given there is one: near enough
/// that the sensor resolves cells and reaches the far side of the box, and else so far off that a sphere around the
/// box fits into the image; never in the box, on the table at most 1.5 m (Vasquez-Gomez et al. 2013).
[[nodiscard]] ObjectScene object_scene(const TriangleMesh& object, const RangeSensor& sensor,
                                       const ObjectSceneOptions& options);

/// A first view of the object: drawn from the seed among the admitted views of the first shell from which the box
/// appears at least 0.9 times as large as from any other. Throws std::invalid_argument if none is admitted.
[[nodiscard]] Pose draw_first_view(const ObjectScene& scene, const Truth& truth, const Platform& platform,
                                   std::uint64_t seed);

/// What the planner `next-best-view` is told of a scene (make_planner): the box, the shells, and that views aimed at
/// what is left stand no further off than the furthest shell and as near as a third of that.
[[nodiscard]] PlannerSettings planner_settings(const ObjectScene& scene);

}  // namespace vantage
