// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/following.hpp>
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
    sensor.validate();  // before anything is made
    if (!caster_.follow(map)) {
      return false;
    }
    rays_.emplace(sensor.rays_for(map.resolution_m()));
    medium_rays_.emplace(sensor.rays_for(0.5 * kSparse * map.resolution_m()));
    sparse_rays_.emplace(sensor.rays_for(kSparse * map.resolution_m()));
    if (const double excess = static_cast<double>(sparse_rays_->size()) / kMostSparse; excess > 1.0) {
      sparse_rays_.emplace(sensor.rays_for(std::sqrt(excess) * kSparse * map.resolution_m()));
    }
    return true;
  }

  /// The caster of the last followed map. Requires a call of `follow`.
  [[nodiscard]] const RayCaster& caster() const { return *caster_; }
  /// The rays of the sensor, as dense as the cells of the map require. Requires a call of `follow`.
  [[nodiscard]] const ViewRays& rays() const { return *rays_; }
  /// About a quarter of `rays()`, to rank the best views of a first ranking. Requires a call of `follow`.
  [[nodiscard]] const ViewRays& medium_rays() const { return *medium_rays_; }
  /// About a sixteenth of `rays()`, at most about 1,000, for a first ranking of many views. Requires a call of
  /// `follow`.
  [[nodiscard]] const ViewRays& sparse_rays() const { return *sparse_rays_; }

 private:
  static constexpr double kSparse = 4.0;  // factor on the distance between rays
  static constexpr double kMostSparse = 1000.0;

  Following<RayCaster> caster_;
  std::optional<ViewRays> rays_;
  std::optional<ViewRays> medium_rays_;
  std::optional<ViewRays> sparse_rays_;
};

}  // namespace vantage
