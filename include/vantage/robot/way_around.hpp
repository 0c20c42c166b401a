// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A path between two views of an object, as poses (world_from_sensor) joined by admitted motions. Tries the
/// straight motion first, then an arc around `middle` (metres, world), because both are quickly checked, then the
/// platform's own path search. None if all fail.
[[nodiscard]] std::optional<std::vector<Pose>> way_around(const OccupancyMap& map, const Platform& platform,
                                                          const Pose& from, const Pose& to,
                                                          const Eigen::Vector3d& middle);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/way_around.ipp>
#endif
