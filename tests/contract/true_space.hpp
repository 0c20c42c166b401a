// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vantage/map/height_band.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

#include "contract/changing_world.hpp"
#include "contract/scene.hpp"
#include "contract/slow_audit.hpp"

#include <vantage/robot/impl/swept_sphere.hpp>

namespace vantage::testing {

/// What is in the way of a body in the world of a scene, as far as it does not move: solid cells or, for a robot that
/// drives, the columns with something in the band of heights or without a floor.
class TrueSpace {
 public:
  TrueSpace(const Scene& scene, const ChangingWorld& world) : scene_(scene), world_(world), map_(options(world)) {
    for_each_cell(world.solid.box(), [&](const VoxelIndex& cell) {
      map_.set(cell, world.solid[cell] != 0 ? Occupancy::Occupied : Occupancy::Free);
    });
    if (scene.drives) {
      HeightBand band(map_.options(), band_above_floor(scene.cell_m));
      band.follow(map_);
      map_ = band.plane();
    }
  }

  /// The map of all that the world holds.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  [[nodiscard]] bool is_solid(const VoxelIndex& cell) const { return !map_.is_clear(cell); }
  /// The cells that the body overlaps, `gap_m` wider than it is, and that satisfy `wanted`.
  template <class Wanted>
  [[nodiscard]] std::vector<VoxelIndex> touched(const Pose& pose, double gap_m, Wanted&& wanted) const {
    const Eigen::Vector3d end = rod_end(pose, scene_.rod_cells * scene_.cell_m);
    const VoxelIndex at = world_.frame.cell_of(pose.translation());
    const auto reach = 2 + static_cast<std::int32_t>(std::ceil(scene_.rod_cells));
    std::vector<VoxelIndex> cells;
    for_each_cell(VoxelBox{at, at + VoxelIndex{1, 1, 1}}.grown(reach), [&](const VoxelIndex& cell) {
      if (!(scene_.is_plane() && cell.z != at.z) && wanted(cell) &&
          detail::distance_to_segment(world_.filled(cell), pose.translation(), end) < scene_.radius_m() + gap_m) {
        cells.push_back(cell);
      }
    });
    return cells;
  }
  /// The share of the observable cells that `known` knows: those where the body fits and to which it can go, and
  /// those that the sensor sees from there.
  [[nodiscard]] double coverage(const OccupancyMap& known, const Platform& platform,
                                const RangeSensor& sensor) const {
    std::vector<VoxelIndex> places{world_.start};
    std::set<VoxelIndex> found(places.begin(), places.end());
    for (std::size_t next = 0; next < places.size(); ++next) {
      for (const VoxelIndex& step : kFaceNeighbours) {
        const VoxelIndex cell = places[next] + step;
        if (platform.admits_cell(map_, cell) && !world_.has_sheet(cell) && found.insert(cell).second) {
          places.push_back(cell);
        }
      }
    }
    std::size_t observable = 0;
    std::size_t seen = 0;
    map_.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      const Eigen::Vector3d centre = world_.frame.centre_of(cell);
      const auto sees = [&](const VoxelIndex& place) {
        const Eigen::Vector3d from = world_.frame.centre_of(place);
        const Pose facing = platform.facing(from, centre - from);
        return (centre - from).norm() >= sensor.min_range_m && (centre - from).norm() <= sensor.max_range_m &&
               sensor.in_view(facing.linear().transpose() * (centre - from)) && in_sight(from, cell) &&
               (scene_.rod_cells == 0.0 || platform.admits(map_, facing));
      };
      if (state == Occupancy::Free && !world_.is_solid(cell) &&
          (found.contains(cell) || std::any_of(places.begin(), places.end(), sees))) {
        ++observable;
        seen += known.at(cell) != Occupancy::Unknown ? 1U : 0U;
      }
    });
    EXPECT_GT(observable, 50U);
    return static_cast<double>(seen) / static_cast<double>(observable);
  }

 private:
  [[nodiscard]] static OccupancyMapOptions options(const ChangingWorld& world) {
    return {.resolution_m = world.frame.size_m, .region = world.frame.box_of(world.solid.box())};
  }

  // In a band, an obstacle that is lower than the sensor is in the way of its sight, too.
  [[nodiscard]] bool in_sight(const Eigen::Vector3d& from, const VoxelIndex& cell) const {
    const VoxelRay line(world_.frame, from, world_.frame.centre_of(cell));
    return world_.in_sight(from, cell) && (!scene_.drives || line.all_from_the_end([&](const VoxelIndex& met) {
             return map_.at(met) == Occupancy::Free;
           }));
  }

  const Scene& scene_;
  const ChangingWorld& world_;
  OccupancyMap map_;
};

}  // namespace vantage::testing
