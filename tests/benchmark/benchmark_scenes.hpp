// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace vantage {

/// A pinhole depth image (f = 525 px at 640 columns) of a laid table in a closed room of 4 x 4 x 3.2 m, seen from a
/// corner at 1.5 m. Depths carry the seeded noise of a structured-light camera, 1 mm at 1 m and growing with its
/// square.
[[nodiscard]] Scan table_scan(std::size_t width = 640, std::size_t height = 480, std::uint32_t seed = 1);
/// The same from another place in the room.
[[nodiscard]] Scan table_scan(const Pose& world_from_sensor, std::size_t width = 640, std::size_t height = 480,
                              std::uint32_t seed = 1);

/// A scan of a lidar of 64 x 1,024 rays and a range of 20 m in a hall of 36 x 18 x 7 m with pillars and crates, its
/// points shuffled: an unorganised scan.
[[nodiscard]] Scan hall_scan(std::uint32_t seed = 1);

/// What is known around an object.
enum class Surroundings {
  Known,    ///< all of the room
  Scanned,  ///< what six scans from places around it have seen
};

/// An object that is to be seen, on the table of that room, and from where it might be.
struct ObjectScene {
  OccupancyMap map;         ///< of the object box only what one first scan saw is known
  VoxelBox object;          ///< cells of the object box
  std::vector<Pose> views;  ///< 1.5 m from its centre, looking at it: those of 320 all around that are in free space
};
[[nodiscard]] ObjectScene object_scene(double resolution_m, Surroundings surroundings = Surroundings::Known,
                                       std::uint32_t seed = 1);

}  // namespace vantage
