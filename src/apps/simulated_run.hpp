// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/world.hpp>

#include "apps/explore_request.hpp"

// A run in a simulated world, as the commands explore and evaluate make it. Each function throws
// std::invalid_argument or std::runtime_error with the option or file at fault.
namespace vantage::apps {

/// The sensor, and what carries it.
struct SensorCarrier {
  RangeSensor sensor;
  std::shared_ptr<const Platform> platform = nullptr;
};
/// In a world that is a plane, a sensor of that plane; there and with a band it drives.
[[nodiscard]] SensorCarrier carrier_of(const ExploreRequest& request);

[[nodiscard]] std::unique_ptr<ExplorationPlanner> planner_of(const ExploreRequest& request,
                                                             const SensorCarrier& carrier);

/// A world and the part of it to explore.
struct ExploredWorld {
  World world;
  Box region = {};
};
/// Refuses a region that holds nothing of the world or cannot be mapped, and a `--start` outside of it.
void check_region(const ExploreRequest& request, const World& world, const Box& region);
[[nodiscard]] ExploredWorld explored_world(const ExploreRequest& request);

[[nodiscard]] ExplorationRunOptions run_options_of(const ExploreRequest& request, const SensorCarrier& carrier,
                                                   const Box& region);

/// The start that was asked for, or else the one drawn from the seed.
[[nodiscard]] Pose start_in(const ExplorationRun& run, const Platform& platform, const ExploreRequest& request);

/// How a lower bound on the path is found.
enum class BoundWith {
  Pockets,  ///< watchman_bound: seconds
  Route     ///< the larger one of watchman_bound and watchman_route: minutes, in large worlds much longer
};

/// A lower bound on the path from this start. `stop` gives up, see WatchmanOptions.
[[nodiscard]] PathBound bound_of(const ExplorationRun& run, const SensorCarrier& carrier, const Pose& start,
                                 BoundWith with, int threads, const std::function<bool()>& stop = {});

/// Writes into the record of a run what was asked for.
void tell_request(RunRecord& record, const ExploreRequest& request);

}  // namespace vantage::apps
