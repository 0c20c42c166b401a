// SPDX-License-Identifier: MIT

// Where a run starts, and what is declared there.
#include <sstream>
#include <stdexcept>
#include <vantage/planner/assume_free.hpp>
#include <vantage/sim/exploration_run.hpp>

namespace vantage {

void ExplorationRun::check_start(const Pose& start) const {
  const auto refuse = [&](const char* what) {
    std::ostringstream message;
    message << "the start (" << start.translation().x() << ", " << start.translation().y() << ", "
            << start.translation().z() << ") " << what;
    throw std::invalid_argument(message.str());
  };
  if (!is_rigid(start)) {
    refuse("is not a rigid transform");
  }
  if (!truth_.map().frame().addressable(start.translation()) ||
      !truth_.map().in_region(truth_.map().frame().cell_of(start.translation()))) {
    refuse("is outside the region");
  }
  if (!platform_->admits(truth_.map(), start)) {
    if (platform_->admits(truth_.map(), platform_->facing(start.translation(), optical_axis(start)))) {
      refuse("has an orientation that the robot cannot take");
    }
    refuse("is in or too near a wall or the edge of the region for the robot's body");
  }
}

// Declares the space at the start free; in a band at all heights of it, and the floor. Of the clearance only truly
// free cells are declared, and a floor only where there is one.
void ExplorationRun::assume_start_free(const Pose& start) {
  OccupancyMap declared({.resolution_m = map_.resolution_m(), .region = options_.map.region});
  assume_free(declared, *platform_, start);
  const OccupancyMap body = declared;
  assume_free(declared, *platform_, start, options_.start_clearance_m);
  declared.for_each_known([&](const VoxelIndex& cell, Occupancy) {
    const bool truly_free = truth_.map().at(cell) == Occupancy::Free;
    if (!truly_free && body.at(cell) != Occupancy::Free) {
      return;
    }
    const Box box = map_.frame().box_of(cell);
    const Eigen::Vector3d within = 0.25 * box.extent();
    Box inner{box.min + within, box.max - within};
    if (options_.band) {
      inner.min.z() = options_.band->min_height_m;
      inner.max.z() = options_.band->max_height_m;
    }
    map_.assume_free(inner);
  });
  if (!band_ || !options_.band->needs_floor) {
    return;
  }
  const double floor_m = start_floor_m(*band_, *platform_, sensor_);
  truth_.map().for_each_known([&](const VoxelIndex& cell, Occupancy) {
    const Eigen::Vector3d centre = map_.frame().centre_of(cell);
    if ((centre - start.translation()).head<2>().norm() < floor_m && truth_.map().is_clear(cell)) {
      band_->assume_floor(centre, 0.0);
    }
  });
}

}  // namespace vantage
