// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace VANTAGE_EXPORT vantage {

/// A RayCaster and the rays of a sensor that follow a map from call to call. If the map is another one, both are
/// rebuilt.
class FollowingCaster {
 public:
  /// Updates the caster to the current state of `map`, which must outlive the next use of `caster`. The sensor must
  /// be the same in every call. Returns whether the caster was rebuilt. Throws std::length_error if the known cells
  /// are too far apart (see RayCaster), std::invalid_argument for an invalid sensor.
  bool follow(const OccupancyMap& map, const RangeSensor& sensor) {
    if (map_.is_in_place(map)) {
      caster_->update();
      return false;
    }
    map_ = KnownMap();  // refers to no map if one of the next lines throws
    caster_.emplace(map);
    rays_.emplace(sensor.rays_for(map.resolution_m()));
    map_ = KnownMap(map);
    return true;
  }

  /// The caster of the last followed map. Requires a call of `follow`.
  [[nodiscard]] const RayCaster& caster() const { return *caster_; }
  /// The rays of the sensor, as dense as the cells of the map require. Requires a call of `follow`.
  [[nodiscard]] const ViewRays& rays() const { return *rays_; }

 private:
  std::optional<RayCaster> caster_;
  std::optional<ViewRays> rays_;
  KnownMap map_;
};

}  // namespace vantage
