// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "apps/explore_request.hpp"

namespace vantage::apps {

/// Options of `vantage replay` as typed.
struct ReplayRequest {
  std::string dataset;
  std::string format;
  std::string intrinsics;
  double max_range_m = 0.0;  // metres; 0: as the format says
  std::optional<int> disparities_px;
  std::optional<int> window_px;
  std::string up;
  std::size_t every = 1;
  std::string object_box;
  bool select = false;
  ExploreRequest run;  // options that the commands share

  ReplayRequest() {
    run.planner = "harmonic,next-best-view";
    run.resolution_m = 0.05;
    run.robot_radius_m = 0.1;
  }
};

// What the options mean. Each function throws std::invalid_argument or std::runtime_error with the option or file
// at fault.
void check_numbers(const ReplayRequest& request);
[[nodiscard]] Recording recording_of(const ReplayRequest& request);
[[nodiscard]] OccupancyMapOptions map_options_of(const ReplayRequest& request);
/// Box of the recorded object, metres; none without `--object-box`.
[[nodiscard]] std::optional<Box> object_of(const ReplayRequest& request);
/// The planners by their names, in the order asked for.
[[nodiscard]] std::vector<std::unique_ptr<ExplorationPlanner>> planners_of(
    const ReplayRequest& request, const RangeSensor& sensor, const std::shared_ptr<const Platform>& platform);

}  // namespace vantage::apps
