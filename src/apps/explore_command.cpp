// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/report/report_json.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/audit.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/watchman_route.hpp>

#include "apps/commands.hpp"
#include "apps/explore_request.hpp"
#include "apps/help_format.hpp"
#include "apps/mesh_doubts.hpp"
#include "apps/observable_progress.hpp"
#include "apps/progress_stream.hpp"
#include "apps/run_files.hpp"
#include "apps/run_printer.hpp"
#include "apps/run_recording.hpp"
#include "apps/shared_options.hpp"

namespace vantage::apps {
namespace {

void check_plan(const ExploreRequest& request) {
  if (is_world_file(request, World::FileKind::Plan) && !request.band.empty()) {
    throw std::invalid_argument("--band: --world " + request.world + " is a plane already");
  }
}

// In a plane the height of the sensor is given.
std::optional<Pose> start_in_world(const ExploreRequest& request) {
  std::optional<Pose> start = start_of(request);
  if (start && is_world_file(request, World::FileKind::Plan)) {
    start->translation().z() = 0.5 * request.resolution_m;
  }
  return start;
}

void check_region(const ExploreRequest& request, const World& world, const Box& region,
                  const std::optional<Pose>& start) {
  const Box bounds = world.mesh.bounds();
  if (!(region.min.array() < bounds.max.array()).all() || !(region.max.array() > bounds.min.array()).all()) {
    std::ostringstream message;
    message << "--region " << request.region << " holds nothing of the world, which spans " << bounds.min.x() << ','
            << bounds.min.y() << ',' << bounds.min.z() << ',' << bounds.max.x() << ',' << bounds.max.y() << ','
            << bounds.max.z();
    throw std::invalid_argument(message.str());
  }
  check_cell_count(region, request.resolution_m);
  if (start && !region.contains(start->translation())) {
    throw std::invalid_argument("--start " + request.start + " lies outside the region");
  }
}

Pose start_in(const ExplorationRun& run, const Platform& platform, const ExploreRequest& request) {
  const std::optional<Pose> given = start_in_world(request);
  const std::optional<Pose> start = given ? given : run.truth().draw_start(platform, request.seed);
  if (!start) {
    throw std::invalid_argument("--world " + request.world + ": the robot fits nowhere in the region");
  }
  return *start;
}

std::shared_ptr<const Platform> platform_of(const ExploreRequest& request) {
  if (!request.band.empty() || is_world_file(request, World::FileKind::Plan)) {
    return std::make_shared<const GroundRobot>(GroundRobotOptions{.radius_m = request.robot_radius_m});
  }
  return std::make_shared<const FreeFlyer>(
      FreeFlyerOptions{.radius_m = request.robot_radius_m, .yaw_only = request.yaw_only});
}

ExplorationRunOptions run_options_of(const ExploreRequest& request, const Box& region, const Platform& platform,
                                     const RangeSensor& sensor, const Interruption& interruption) {
  ExplorationRunOptions options;
  options.map.resolution_m = request.resolution_m;
  options.map.region = region;
  options.map.keep_grazed_cells = !request.wear;
  options.band = band_of(request);
  options.start_clearance_m = start_clearance_m(platform, sensor);
  options.look_around = request.look_around;
  options.max_views = request.max_views;
  options.scan_spacing_m = request.scan_spacing_m;
  options.motion = motion_of(request);
  options.seed = request.seed;
  options.noise = noise_of(request);
  options.body_radius_m = request.robot_radius_m;
  options.threads = request.threads;
  options.measure_coverage = !request.no_coverage;
  options.stop = [&interruption] { return interruption.asked(); };
  return options;
}

PathBound bound_of(const ExplorationRun& run, const Platform& platform, const RangeSensor& sensor, const Pose& start,
                   int threads) {
  const WatchmanRoute route = watchman_route(run.truth(), platform, sensor, start, {.threads = threads});
  return {route.length_m, route.sees_all};
}

AuditRecord audit_of(const ExplorationRun& run, const Platform& platform, const RangeSensor& sensor,
                     const RunRecord& record, int threads) {
  std::vector<Pose> looked_from;
  for (const ViewRecord& view : record.views) {
    looked_from.push_back(view.pose);
  }
  const AuditResult found = audit(run.known(), platform, sensor, looked_from.back(), looked_from, threads);
  return {.cells_checked = found.cells_checked,
          .looked_at_in_vain = found.looked_at_in_vain,
          .observable_left = found.observable_left};
}

void tell_doubts(const ExploreRequest& request, const Box& bounds) {
  if (!is_world_file(request, World::FileKind::Mesh)) {
    return;
  }
  if (request.scale.value_or(1.0) == 1.0) {
    std::cerr << doubt_about_world_unit(request.world, bounds);
  }
  if (request.up.empty()) {
    std::cerr << doubt_about_axis(request.world, bounds);
  }
}

// NOLINTNEXTLINE(readability-function-size): a run from its options to its files
int explore(const ExploreRequest& request) {
  Interruption interruption;
  check_numbers(request);
  check_targets(request.out, request.json);
  check_plan(request);
  const std::optional<Pose> start = start_in_world(request);
  const RangeSensor sensor =
      is_world_file(request, World::FileKind::Plan) ? in_plane(sensor_of(request)) : sensor_of(request);
  const std::shared_ptr<const Platform> platform = platform_of(request);
  const auto planner = make_planner(request.planner,
                                    {.sensor = sensor,
                                     .platform = platform,
                                     .seed = request.seed,
                                     .threads = request.threads,
                                     .motion = motion_of(request)},
                                    settings_of(request));
  const std::optional<Box> asked_region = region_of(request);
  const World world = world_of(request);
  tell_doubts(request, world.mesh.bounds());
  Box region = asked_region.value_or(world.region);
  if (world.plan) {
    region.min.z() = 0.0;
    region.max.z() = request.resolution_m;
  }
  check_region(request, world, region, start);

  ExplorationRunOptions options = run_options_of(request, region, *platform, sensor, interruption);
  ObservableProgress observable(request.quiet);
  options.on_observable_share = [&](double share) { observable.tell(share); };
  ExplorationRun run(world, sensor, platform, options);

  ProgressStream told(request);
  std::ostream& progress = told.stream();
  RunPrinter printer(progress, told.is_terminal());
  PlanPictures pictures;
  RunRecording recording(*planner, request.out, recorder_setup(request, "explore", request.world, sensor));
  RunRecord record =
      run.run(recording, start_in(run, *platform, request), [&](const ViewRecord& view, const OccupancyMap& map) {
        if (view.view == 1) {
          interruption.hold();
          printer.head(request.planner, request.world, request.sensor, request.resolution_m, request.seed);
        }
        printer.view(view);
        recording.look(view, map);
        if (view.plan_ms > 0.0 && !request.out.empty()) {
          pictures.look(*planner, map, view);
        }
      });
  record.command = "explore";
  record.world = request.world;
  record.planner = request.planner;
  record.seed = request.seed;
  record.threads = request.threads;
  record.resolution_m = request.resolution_m;
  printer.summary(record);
  if (record.coverage) {
    printer.observable(observable.seconds());
  }
  recording.finish(record);
  if (request.audit && !interruption.asked()) {
    printer.working("audit", "checking what could still be observed ...");
    record.audit = audit_of(run, *platform, sensor, record, request.threads);
    printer.audit(record);
  }
  if (request.bound && !interruption.asked()) {
    printer.working("bound", "seeking the shortest way that sees all ...");
    record.path_bound = bound_of(run, *platform, sensor, record.views.front().pose, request.threads);
    printer.bound(record);
  }
  progress << recording.cost(record);
  write_outputs(request.out, request.json, record, run.map(), sensor, pictures.pictures(), progress,
                recording.file());
  return exit_code_of(record.outcome, interruption);
}

void add_world_options(CLI::App& command, ExploreRequest& request) {
  command
      .add_option("--world", request.world,
                  "By name (vantage list), a mesh, an OctoMap, or a nav2 map (.yaml); must be given")
      ->required()
      ->type_name("NAME|FILE")
      ->group("World");
  command.add_option("--up", request.up, "Axis of a mesh file that points up; unless given as the file says, else z")
      ->type_name("y|z")
      ->group("World");
  command.add_option("--scale", request.scale, "Metres per unit of a mesh file")
      ->type_name("S")
      ->check(a_number())
      ->default_str("1")
      ->group("World");
  command.add_option("--size", request.size, "Extent of a generated world (office, maze), metres")
      ->type_name("LENGTH,WIDTH")
      ->group("World");
  command.add_option("--region", request.region, "What to explore, metres; all of the world unless given")
      ->type_name("x0,y0,z0,x1,y1,z1")
      ->group("World");
}

void add_robot_options(CLI::App& command, ExploreRequest& request) {
  command.add_option("--start", request.start, "First pose of the sensor, metres and degrees; drawn unless given")
      ->type_name("x,y,z[,yaw[,pitch]]")
      ->group("Robot");
  add_sensor_options(command, request, "Robot");
  command.add_flag("--yaw-only", request.yaw_only, "The sensor stays level")->group("Robot");
  command
      .add_option("--band", request.band,
                  "It drives, and explores the plane of these heights; the sensor is in the middle")
      ->type_name("LOW,HIGH[,SENSOR]")
      ->group("Robot");
  command
      .add_flag("--look-around", request.look_around, "It turns once on the spot, scanning, before the first plan")
      ->group("Robot");
  command.add_option("--scan-spacing", request.scan_spacing_m, "Metres between scans on the way; 0: at goals only")
      ->type_name("M")
      ->check(a_number())
      ->capture_default_str()
      ->group("Robot");
}

void add_motion_options(CLI::App& command, ExploreRequest& request) {
  const auto option = [&](const char* name, std::optional<double>& value, const char* type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->check(a_number())->group("Robot in time");
  };
  option("--max-speed", request.max_speed_m_s, "M/S", "The run is timed: how fast it moves");
  option("--max-acceleration", request.max_acceleration_m_s2, "M/S2", "Speeding up, braking and in corners");
  option("--max-yaw-rate", request.max_yaw_rate_deg_s, "DEG/S", "How fast it turns");
  option("--max-yaw-acceleration", request.max_yaw_acceleration_deg_s2, "DEG/S2", "Unlimited unless given");
  option("--scan-rate", request.scan_rate_hz, "HZ", "Scans a second, while it moves and turns");
  option("--planning-latency", request.planning_latency_s, "S",
         "From a scan until the plan made from it takes effect")
      ->default_str("0.05");
}

}  // namespace

void add_explore_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("explore", "Let a simulated robot explore a known world");
  const auto request = std::make_shared<ExploreRequest>();
  add_world_options(*command, *request);
  add_robot_options(*command, *request);
  add_motion_options(*command, *request);
  command->add_option("--planner", request->planner, "By name (vantage list)")
      ->type_name("NAME")
      ->capture_default_str()
      ->group("Run");
  command->add_flag("--wear", request->wear, "Rays at a small angle wear away the surface they end in, as in OctoMap")
      ->group("Run");
  command
      ->add_flag("--bound", request->bound,
                 "At the end, find the shortest route with full knowledge of the world; slow")
      ->group("Run");
  command
      ->add_flag("--no-coverage", request->no_coverage,
                 "Do not measure coverage, so that the first view need not wait for it")
      ->group("Run");
  command
      ->add_flag("--audit", request->audit,
                 "At the end, check by brute force that nothing is left that could be observed; slow")
      ->group("Run");
  add_setting_option(*command, *request, "A setting of the planner, as often as needed; a wrong key lists them");
  add_run_options(*command, *request);
  add_output_options(*command, *request);
  command->footer(
      "Examples:\n"
      "  vantage explore --world rooms --out rooms\n"
      "  vantage explore --world office --planner frontier-gain --sensor kinect --set hypotheses=300 --seed 7\n"
      "  vantage explore --world office --size 15,10 --band 0.2,1.4 --look-around --sensor stereo\n"
      "  vantage explore --world house.dae --up y --region -9,-5,0.1,9,5,2.4 --resolution 0.1 --json - --quiet\n"
      "Exit codes: 0 nothing observable is left, 2 bad input (nothing was written) or a file that cannot be\n"
      "written, 3 the views were spent, 4 something is left that cannot be reached, 130 and 143 interrupted.");
  command->callback([command, request, &exit_code] {
    if (command->count("--max-views") == 0 && request->scan_rate_hz) {
      constexpr double kHourS = 3600.0;
      request->max_views = static_cast<std::size_t>(std::clamp(kHourS * *request->scan_rate_hz, 1.0, 1e7));
    }
    exit_code = explore(*request);
  });
}

}  // namespace vantage::apps
