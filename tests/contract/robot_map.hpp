// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vantage/map/height_band.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/assume_free.hpp>

#include "contract/changing_world.hpp"
#include "contract/scene.hpp"
#include "contract/true_space.hpp"

namespace vantage::testing {

/// The map that a robot makes of a world, with a band of heights if the robot drives.
class RobotMap {
 public:
  RobotMap(const Scene& scene, const ChangingWorld& world)
      : scene_(scene),
        world_(world),
        map_({.resolution_m = scene.cell_m, .region = world.frame.box_of(world.solid.box())}) {
    if (scene.drives) {
      band_.emplace(map_.options(), band_above_floor(scene.cell_m));
    }
  }

  /// The map that the planner plans in.
  [[nodiscard]] const OccupancyMap& known() const { return band_ ? band_->plane() : map_; }
  void insert(const Scan& scan) {
    map_.insert(scan);
    if (band_) {
      band_->follow(map_);
    }
  }
  /// Declares the space around the robot free; in a band at all heights, in columns that are free in the true space.
  void declare_free(const Platform& platform, const Pose& pose, double clearance_m, const TrueSpace& space) {
    if (band_) {
      declare_columns_free(platform, pose, clearance_m, space);
      return;
    }
    assume_free(map_, platform, pose, clearance_m);
    if (scene_.rod_cells > 0.0) {
      map_.assume_free(platform.body_box(pose));
    }
  }
  /// Declares the floor around the robot, in a band, where there is one.
  void declare_floor(const Platform& platform, const Pose& pose, const RangeSensor& sensor, const TrueSpace& space) {
    if (!band_) {
      return;
    }
    const double floor_m = start_floor_m(*band_, platform, sensor);
    space.map().for_each_known([&](const VoxelIndex& column, Occupancy /*state*/) {
      const Eigen::Vector3d centre = world_.frame.centre_of(column);
      if (!space.is_solid(column) && (centre - pose.translation()).head<2>().norm() < floor_m) {
        band_->assume_floor(centre, 0.0);
      }
    });
    band_->follow(map_);
  }
  /// Solid cells become unknown: the operator does not declare them free.
  void forget_solid_cells() {
    for_each_cell(world_.solid.box(), [&](const VoxelIndex& cell) {
      if (world_.is_solid(cell)) {
        map_.set(cell, Occupancy::Unknown);
      }
    });
  }

 private:
  void declare_columns_free(const Platform& platform, const Pose& pose, double clearance_m, const TrueSpace& space) {
    OccupancyMap plane(known().options());
    assume_free(plane, platform, pose, clearance_m);
    plane.assume_free(platform.body_box(pose));
    plane.for_each_known([&](const VoxelIndex& column, Occupancy /*state*/) {
      if (!space.is_solid(column)) {
        Box box = world_.frame.box_of(column);
        box.min.head<2>().array() += 0.25 * scene_.cell_m;
        box.max.head<2>().array() -= 0.25 * scene_.cell_m;
        box.min.z() = band_->options().min_height_m + 0.25 * scene_.cell_m + 1e-9;
        box.max.z() = band_->options().max_height_m - 1e-9;
        map_.assume_free(box);
      }
    });
    band_->follow(map_);
  }

  const Scene& scene_;
  const ChangingWorld& world_;
  OccupancyMap map_;
  std::optional<HeightBand> band_;
};

}  // namespace vantage::testing
