// SPDX-License-Identifier: MIT
#include "apps/simulated_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vantage/evaluation/exploration_peers.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/watchman_bound.hpp>
#include <vantage/sim/watchman_route.hpp>

namespace vantage::apps {
namespace {

bool is_among(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

bool is_plan(const ExploreRequest& request) { return is_world_file(request, World::FileKind::Plan); }

// In a plane the height of the sensor is given.
std::optional<Pose> start_in_world(const ExploreRequest& request) {
  std::optional<Pose> start = start_of(request);
  if (start && is_plan(request)) {
    start->translation().z() = 0.5 * request.resolution_m;
  }
  return start;
}

// Where the floor is deeper than the robot can drive down, no scan shows one.
void check_floor(const ExploreRequest& request, const TriangleScene& scene, const Eigen::Vector3d& start) {
  const std::optional<HeightBandOptions> band = band_of(request);
  const auto below_m = scene.hit_distance(start, -Eigen::Vector3d::UnitZ(), std::numeric_limits<double>::infinity());
  if (!band || !band->needs_floor) {
    return;
  }
  if (!below_m) {
    throw std::invalid_argument("--band " + request.band +
                                ": there is no floor below the start (--no-floor: the robot needs none)");
  }
  const double floor_m = std::round(1e3 * (start.z() - *below_m)) / 1e3;  // a ray is off by some 1e-8
  const double highest_m = floor_m + band->step_height_m;
  if (band->min_height_m >= highest_m) {
    std::ostringstream message;
    message << "--band " << request.band << ": the floor at the start is at " << floor_m
            << " m, more than the step of " << band->step_height_m
            << " m that the robot can drive down: LOW must be less than " << highest_m;
    throw std::invalid_argument(message.str());
  }
}

// Why a robot that drives may fit nowhere: a floor that reaches into the band stands in its way everywhere.
std::string floor_of_band(const ExploreRequest& request) {
  const std::optional<HeightBandOptions> options = band_of(request);
  if (!options) {
    return "";
  }
  const HeightBand band({.resolution_m = request.resolution_m}, *options);
  std::ostringstream why;
  why << "; it is too large, or the lowest cells of --band " << request.band << " begin at "
      << band.plane().frame().corner_of({0, 0, band.layers().first}).z() << " m, and the floor must lie below that";
  if (options->needs_floor) {
    why << " and at most " << options->step_height_m << " m below LOW (--no-floor: there may be none)";
  }
  return why.str();
}

}  // namespace

void check_region(const ExploreRequest& request, const World& world, const Box& region) {
  const Box bounds = world.mesh.bounds();
  if (!(region.min.array() < bounds.max.array()).all() || !(region.max.array() > bounds.min.array()).all()) {
    std::ostringstream message;
    message << (request.region.empty() ? "--world " + request.world + " spans no space: "
                                       : "--region " + request.region + " holds nothing of the world, which spans ")
            << bounds.min.x() << ',' << bounds.min.y() << ',' << bounds.min.z() << ',' << bounds.max.x() << ','
            << bounds.max.y() << ',' << bounds.max.z();
    throw std::invalid_argument(message.str());
  }
  check_cells(request.region.empty() ? "--world " + request.world : "--region " + request.region,
              is_world_file(request, World::FileKind::Mesh), region, request.resolution_m);
  const std::optional<Pose> start = start_in_world(request);
  if (start && !region.contains(start->translation())) {
    throw std::invalid_argument("--start " + request.start + " lies outside the region");
  }
}

SensorCarrier carrier_of(const ExploreRequest& request) {
  if (is_plan(request) && !request.band.empty()) {
    throw std::invalid_argument("--band: --world " + request.world + " is a plane already");
  }
  (void)start_in_world(request);  // a faulty start is found before the world is read
  SensorCarrier carrier{.sensor = is_plan(request) ? in_plane(sensor_of(request)) : sensor_of(request)};
  // A robot that does not stop meets more walls that its sensor saw only in passing.
  std::optional<double> margin_m;
  if (request.max_speed_m_s) {
    margin_m = std::max(request.resolution_m - request.robot_radius_m, 0.5 * request.resolution_m);
  }
  if (!request.band.empty() || is_plan(request)) {
    carrier.platform = std::make_shared<const GroundRobot>(
        GroundRobotOptions{.radius_m = request.robot_radius_m, .margin_m = margin_m});
  } else {
    carrier.platform = std::make_shared<const FreeFlyer>(
        FreeFlyerOptions{.radius_m = request.robot_radius_m, .margin_m = margin_m, .yaw_only = request.yaw_only});
  }
  return carrier;
}

std::unique_ptr<ExplorationPlanner> planner_of(const ExploreRequest& request, const SensorCarrier& carrier) {
  const PlannerSetup setup{.sensor = carrier.sensor,
                           .platform = carrier.platform,
                           .seed = request.seed,
                           .threads = request.threads,
                           .motion = motion_of(request)};
  const Settings settings = settings_of(request);
  if (is_among(exploration_peer_names(), request.planner)) {
    if (!settings.empty()) {
      throw std::invalid_argument("the planner " + request.planner + " has no settings");
    }
    return make_exploration_peer(request.planner, setup);
  }
  if (!is_among(planner_names(), request.planner)) {
    throw std::invalid_argument("there is no planner '" + request.planner +
                                "'; there are: " + listed(planner_names()) + ", " + listed(exploration_peer_names()));
  }
  return make_planner(request.planner, setup, settings);
}

ExploredWorld explored_world(const ExploreRequest& request) {
  const std::optional<Box> asked = region_of(request);
  ExploredWorld explored{.world = world_of(request)};
  explored.region = asked.value_or(explored.world.region);
  if (explored.world.plan) {
    explored.region.min.z() = 0.0;
    explored.region.max.z() = request.resolution_m;
  }
  check_region(request, explored.world, explored.region);
  return explored;
}

ExplorationRunOptions run_options_of(const ExploreRequest& request, const SensorCarrier& carrier, const Box& region) {
  ExplorationRunOptions options;
  options.map.resolution_m = request.resolution_m;
  options.map.region = region;
  options.map.keep_grazed_cells = !request.wear;
  options.map.max_bytes = max_bytes_of(request.memory_limit_mb);
  options.band = band_of(request);
  if (options.band) {
    try {
      const HeightBand band({.resolution_m = request.resolution_m}, *options.band);
      HeightBandOptions in_region = *options.band;
      in_region.needs_floor = false;  // the run maps the floor below the region, too
      (void)HeightBand(options.map, in_region);
      if (options.band->needs_floor) {
        (void)start_floor_m(band, *carrier.platform, carrier.sensor);
      }
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("--band '" + request.band + "': " + error.what() +
                                  (request.no_floor ? "" : " (--no-floor: the robot needs none)"));
    }
  }
  options.start_clearance_m = start_clearance_m(OccupancyMap(options.map), *carrier.platform, carrier.sensor);
  options.look_around = request.look_around;
  options.max_views = request.max_views;
  options.scan_spacing_m = request.scan_spacing_m;
  options.motion = motion_of(request);
  options.seed = request.seed;
  options.noise = noise_of(request);
  options.body_radius_m = request.robot_radius_m;
  options.threads = request.threads;
  options.measure_coverage = !request.no_coverage;
  return options;
}

Pose start_in(const ExplorationRun& run, const Platform& platform, const ExploreRequest& request) {
  std::optional<Pose> start = start_in_world(request);
  if (start) {
    check_floor(request, run.scene(), start->translation());
    naming("--start " + request.start, [&] { run.check_start(*start); });
  } else {
    start = run.truth().draw_start(platform, request.seed);
  }
  if (!start) {
    throw std::invalid_argument("--world " + request.world + ": the robot fits nowhere in the region" +
                                floor_of_band(request));
  }
  check_floor(request, run.scene(), start->translation());
  return *start;
}

PathBound bound_of(const ExplorationRun& run, const SensorCarrier& carrier, const Pose& start, BoundWith with,
                   int threads, const std::function<bool()>& stop) {
  PathBound bound;
  if (with == BoundWith::Route) {
    const WatchmanRoute route =
        watchman_route(run.truth(), *carrier.platform, carrier.sensor, start, {.threads = threads, .stop = stop});
    bound = {route.length_m, route.sees_all};
  }
  if (!bound.is_met && !(stop && stop())) {
    bound.length_m = std::max(bound.length_m,
                              watchman_bound(run.truth(), *carrier.platform, carrier.sensor, start, threads, stop));
  }
  return bound;
}

void tell_request(RunRecord& record, const ExploreRequest& request) {
  record.command = "explore";
  record.world = request.world;
  record.planner = request.planner;
  record.seed = request.seed;
  record.threads = request.threads;
  record.resolution_m = request.resolution_m;
}

}  // namespace vantage::apps
