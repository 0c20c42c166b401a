// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// Writes free space to the map around the start of a robot: all still unknown cells that its body touches at `pose`
/// (world_from_sensor), and those within a cell and within `clearance_m` metres of the sensor. The caller vouches
/// that this space is free. Known cells do not change. Throws std::invalid_argument unless `clearance_m` is in [0,
/// 5].
///
///     assume_free(map, *platform, pose, start_clearance_m(map, *platform, sensor));
void assume_free(OccupancyMap& map, const Platform& platform, const Pose& pose, double clearance_m = 0.0);

/// The radius around the sensor, metres, that should be declared free at the start. A sensor with a narrow field of
/// view does not see what lies beside the body, so the body must first move through unseen space until the space that
/// it needs fits into the view. 0 for a sensor that sees all around and has minimum range 0; at most 5.
[[nodiscard]] double start_clearance_m(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor);

/// The radius around the sensor, metres, in which a floor should be declared at the start of a robot that drives:
/// that of its body, or up to where a level sensor sees a floor one step below the band, in the corners of its image,
/// plus a cell. Throws std::invalid_argument, which names HeightBandOptions::needs_floor, if the corners show no such
/// floor.
///
///     band.assume_floor(pose.translation(), start_floor_m(band, *platform, sensor));
[[nodiscard]] double start_floor_m(const HeightBand& band, const Platform& platform, const RangeSensor& sensor);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/assume_free.ipp>
#endif
