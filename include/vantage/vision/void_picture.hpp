// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/ellipsoid.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/picture.hpp>

namespace VANTAGE_EXPORT vantage {

/// What a search of voids found and chose. Spans must outlive the call only.
struct VoidContent {
  std::string title = {};                       ///< above the picture
  std::span<const VoxelIndex> voids = {};       ///< void cells
  std::span<const VoxelIndex> frontier = {};    ///< frontier cells
  std::span<const Ellipsoid> ellipsoids = {};   ///< of the voids that have a frontier
  std::span<const VoxelIndex> places = {};      ///< cells with a utility
  std::span<const std::uint64_t> utility = {};  ///< what each of `places` has accumulated, > 0
  Pose sensor = Pose::Identity();               ///< where the sensor is
  std::optional<Pose> view = std::nullopt;      ///< where it is to look next
  std::optional<Box> extent = std::nullopt;     ///< the part of the world to show; none: all that is known
};

/// The map from above with voids in violet, frontiers in red and the ellipsoids of the voids outlined, as Fig. 2 and
/// 3 of Dornhege & Kleiner 2011. Throws std::invalid_argument if the extent is empty.
[[nodiscard]] Picture draw_voids(const OccupancyMap& map, const VoidContent& content);

/// The map from above with the largest utility of every column of places, from red (low) by yellow to green (high),
/// and the view that was chosen, as Fig. 4 of Dornhege & Kleiner 2011. Throws std::invalid_argument if `places` and
/// `utility` differ in length or the extent is empty.
[[nodiscard]] Picture draw_void_utility(const OccupancyMap& map, const VoidContent& content);

}  // namespace vantage
