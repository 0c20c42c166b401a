// SPDX-License-Identifier: MIT
#include "apps/replay_request.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/planner/make_planner.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage::apps {
namespace {

// A message on an option of the library names the flag that gives it.
std::string by_flag(const std::string& message) {
  constexpr std::array<std::pair<const char*, const char*>, 4> kFlags{{{"intrinsics", "--intrinsics"},
                                                                       {"max_range_m", "--max-range"},
                                                                       {"stereo", "--disparities or --window"},
                                                                       {"up", "--up"}}};
  for (const auto& [field, flag] : kFlags) {
    const std::string named = std::string("RecordingOptions::") + field;
    if (message.starts_with(named)) {
      return flag + message.substr(named.size());
    }
  }
  return message;
}

}  // namespace

void check_numbers(const ReplayRequest& request) {
  check_numbers(request.run);
  detail::require_option(request.max_range_m >= 0.0 && request.max_range_m <= 1e4, "--max-range", request.max_range_m,
                         "in [0, 10000] metres");
  if (!request.object_box.empty() && !request.select) {
    throw std::invalid_argument("--object-box says what counts for --select, which is not given");
  }
  if (request.select && !request.run.settings.empty()) {
    throw std::invalid_argument("--set does not go with --select, which asks no planner");
  }
  if (request.select && request.run.memory_limit_mb > 0.0) {
    throw std::invalid_argument("--memory-limit does not go with --select, which compares all that the views show");
  }
  if (const std::optional<Box> object = object_of(request)) {
    check_cells("--object-box " + request.object_box, false, *object, request.run.resolution_m);
  }
  detail::require_option(request.every > 0, "--every", request.every, "> 0");
}

Recording recording_of(const ReplayRequest& request) {
  RecordingOptions options;
  options.cell_m = request.run.resolution_m;
  if (request.max_range_m > 0.0) {
    options.max_range_m = request.max_range_m;
  }
  options.up = request.up;
  if (request.disparities_px || request.window_px) {
    options.stereo.emplace();
    options.stereo->disparities_px = request.disparities_px.value_or(options.stereo->disparities_px);
    options.stereo->window_px = request.window_px.value_or(options.stereo->window_px);
  }
  if (!request.intrinsics.empty()) {
    const std::vector<double> n = numbers_of("--intrinsics", request.intrinsics);
    if (n.size() != 4) {
      throw std::invalid_argument("--intrinsics has " + std::to_string(n.size()) + " numbers, must be fx,fy,cx,cy");
    }
    options.intrinsics = {n[0], n[1], n[2], n[3]};
  }
  try {
    return Recording::open(request.format, request.dataset, options);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(by_flag(error.what()));
  }
}

OccupancyMapOptions map_options_of(const ReplayRequest& request) {
  return {.resolution_m = request.run.resolution_m,
          .region = region_of(request.run),
          .max_bytes = max_bytes_of(request.run.memory_limit_mb)};
}

std::optional<Box> object_of(const ReplayRequest& request) {
  return request.object_box.empty() ? std::nullopt : std::optional(box_of("--object-box", request.object_box));
}

std::vector<std::unique_ptr<ExplorationPlanner>> planners_of(const ReplayRequest& request, const RangeSensor& sensor,
                                                             const std::shared_ptr<const Platform>& platform) {
  std::vector<std::unique_ptr<ExplorationPlanner>> planners;
  std::istringstream names(request.run.planner);
  for (std::string name; std::getline(names, name, ',');) {
    planners.push_back(make_planner(
        name, {.sensor = sensor, .platform = platform, .seed = request.run.seed, .threads = request.run.threads},
        settings_of(request.run)));
  }
  if (planners.empty()) {
    throw std::invalid_argument("--planner names no planner");
  }
  return planners;
}

}  // namespace vantage::apps
