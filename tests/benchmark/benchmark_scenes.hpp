// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace vantage {

/// A simulated depth image (pinhole, f = 525 px at 640 columns) of a set table in a closed room of 4 x 4 x 3.2 m,
/// from a corner at a height of 1.5 m. Depths have the random noise of a structured-light camera, 1 mm at 1 m,
/// growing with the square of the depth.
[[nodiscard]] Scan table_scan(std::size_t width = 640, std::size_t height = 480, std::uint32_t seed = 1);
/// The same scene from another pose.
[[nodiscard]] Scan table_scan(const Pose& world_from_sensor, std::size_t width = 640, std::size_t height = 480,
                              std::uint32_t seed = 1);

/// A simulated, unorganised lidar scan (64 x 1,024 rays, range 20 m, shuffled points) in a hall of 36 x 18 x 7 m with
/// pillars and crates.
[[nodiscard]] Scan hall_scan(std::uint32_t seed = 1);

/// What is known around the object.
enum class Surroundings {
  Known,    ///< the whole room
  Scanned,  ///< what six scans from places around it have observed
};

/// A partly observed object on the table of that room, and candidate views of it.
struct ObjectScene {
  OccupancyMap map;         ///< in the object's box, only what one scan has observed is known
  VoxelBox object;          ///< cells of the object's box
  std::vector<Pose> views;  ///< those of 320 views around the object, 1.5 m from its centre, that are in free space
};
[[nodiscard]] ObjectScene object_scene(double resolution_m, Surroundings surroundings = Surroundings::Known,
                                       std::uint32_t seed = 1);

}  // namespace vantage
