// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/ellipsoid.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/picture/picture.hpp>

namespace VANTAGE_EXPORT vantage {

/// What the two pictures of voids show. The spans must be valid during the call.
struct VoidContent {
  std::string title = {};                       ///< drawn above the picture
  std::span<const VoxelIndex> voids = {};       ///< void cells
  std::span<const VoxelIndex> frontier = {};    ///< frontier cells
  std::span<const Ellipsoid> ellipsoids = {};   ///< ellipsoids of the voids with a frontier
  std::span<const VoxelIndex> places = {};      ///< reachable cells with a utility
  std::span<const std::uint64_t> utility = {};  ///< accumulated utility of each of `places`, > 0
  Pose sensor = Pose::Identity();               ///< current pose (world_from_sensor)
  std::optional<Pose> view = std::nullopt;      ///< the chosen view (world_from_sensor); none: not drawn
};

/// Draws the map from above with voids in violet, frontiers in red, and the outlines of the ellipsoids, as Fig. 2 and
/// 3 of Dornhege & Kleiner 2011. Throws std::invalid_argument if the map knows no cell.
[[nodiscard]] Picture draw_voids(const OccupancyMap& map, const VoidContent& content);

/// Draws the map from above with the largest utility in every column, from red (low) over yellow to green (high), and
/// the chosen view, as Fig. 4 of Dornhege & Kleiner 2011. Throws std::invalid_argument if `places` and `utility`
/// differ in length or the map knows no cell.
[[nodiscard]] Picture draw_void_utility(const OccupancyMap& map, const VoidContent& content);

}  // namespace vantage
