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

/// A RayCaster and the rays of a sensor, for whoever is given a map again and again: they follow it through its
/// changes and begin anew with another map.
class FollowingCaster {
 public:
  /// Looks at `map` as it is now, which must outlive the next use of `caster`; the sensor is the same every
  /// time. Returns whether it began anew. Throws std::length_error if cells of the map lie too far apart to be looked
  /// at (RayCaster).
  bool follow(const OccupancyMap& map, const RangeSensor& sensor) {
    if (map_.is_in_place(map)) {
      caster_->update();
      return false;
    }
    map_ = KnownMap();  // none, if what follows throws
    caster_.emplace(map);
    rays_.emplace(sensor.rays_for(map.resolution_m()));
    map_ = KnownMap(map);
    return true;
  }

  /// In the map that was followed last; there must be one.
  [[nodiscard]] const RayCaster& caster() const { return *caster_; }
  /// As dense as its cells ask for.
  [[nodiscard]] const ViewRays& rays() const { return *rays_; }

 private:
  std::optional<RayCaster> caster_;
  std::optional<ViewRays> rays_;
  KnownMap map_;
};

}  // namespace vantage
