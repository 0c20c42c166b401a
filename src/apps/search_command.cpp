// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vantage/arm/arm.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/truth.hpp>
#include <vector>

#include <vantage/settings/impl/option_rule.hpp>
#include "apps/commands.hpp"
#include "apps/exhaustive_planner.hpp"
#include "apps/exhaustive_search.hpp"
#include "apps/explore_request.hpp"
#include "apps/help_format.hpp"
#include "apps/mesh_doubts.hpp"
#include "apps/progress_stream.hpp"
#include "apps/run_files.hpp"
#include "apps/run_printer.hpp"
#include "apps/run_recording.hpp"
#include "apps/shared_options.hpp"
#include "apps/simulated_run.hpp"
#include "apps/tracked_arm.hpp"

namespace vantage::apps {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

// Options of `vantage search` as typed.
struct SearchRequest {
  std::string arm = "tracked";
  std::string links = "base_link,sensor";
  std::string base = "0,0,0,0";
  std::string joints;
  double clear_m = 0.25;
  bool exhaustive = false;
  std::size_t bound = 0;  // number of poses; 0: no bound
  ExploreRequest run;     // options that the commands share

  SearchRequest() {
    run.planner = "frontier-void";
    run.sensor = "kinect";
    run.resolution_m = 0.025;
    run.scan_spacing_m = 0.0;
    run.max_views = 50;
  }
};

KinematicChain chain_of(const SearchRequest& request) {
  const std::size_t comma = request.links.find(',');
  if (comma == std::string::npos) {
    throw std::invalid_argument("--links '" + request.links + "' must be BASE,SENSOR");
  }
  const std::string base = request.links.substr(0, comma);
  const std::string sensor = request.links.substr(comma + 1);
  return request.arm == "tracked" ? KinematicChain::from_urdf_text(kTrackedArm, base, sensor, "the arm 'tracked'")
                                  : KinematicChain::from_urdf(request.arm, base, sensor);
}

std::shared_ptr<const Arm> arm_of(const SearchRequest& request, const KinematicChain& chain,
                                  const ArmOptions& options) {
  return naming("--arm " + request.arm, [&] { return std::make_shared<const Arm>(chain, options); });
}

Pose base_of(const SearchRequest& request) {
  const std::vector<double> n = numbers_of("--base", request.base);
  if (n.size() < 3 || n.size() > 4) {
    throw std::invalid_argument("--base has " + std::to_string(n.size()) + " numbers, must be x,y,z[,yaw_deg]");
  }
  return Eigen::Translation3d(n[0], n[1], n[2]) *
         Eigen::AngleAxisd(n.size() > 3 ? n[3] * kRadiansPerDegree : 0.0, Eigen::Vector3d::UnitZ());
}

// First joints: the tracked arm looks over its tracks, bent back; any other arm stands in the middle of its
// ranges.
Joints start_joints(const SearchRequest& request, const KinematicChain& chain) {
  Joints joints;
  if (!request.joints.empty()) {
    for (const double degrees : numbers_of("--joints", request.joints)) {
      joints.push_back(degrees * kRadiansPerDegree);
    }
  } else if (request.arm == "tracked") {
    joints = {0.0, -0.7, 1.5, 0.0, 0.0};
  } else {
    for (const JointRange& range : chain.ranges()) {
      joints.push_back(0.5 * (range.min + range.max));
    }
  }
  if (!chain.in_range(joints)) {
    throw std::invalid_argument("--joints must be " + std::to_string(chain.joint_count()) +
                                " angles in degrees within the ranges of the joints");
  }
  return joints;
}

// Box of the whole body at these joints with `clear_m` around it, metres; nothing below the base.
Box body_at(const SearchRequest& request, const KinematicChain& chain, const Pose& world_from_base,
            const Joints& joints) {
  const std::vector<Pose> links = chain.link_poses(joints);
  Box box;
  for (const Capsule& capsule : chain.capsules()) {
    const Pose world_from_link = world_from_base * links[capsule.link];
    for (const Eigen::Vector3d& end : {capsule.from_m, capsule.to_m}) {
      const Eigen::Vector3d reach = Eigen::Vector3d::Constant(capsule.radius_m + request.clear_m);
      box.extend(world_from_link * end - reach);
      box.extend(world_from_link * end + reach);
    }
  }
  // The base stands on the floor.
  box.min.z() = std::max(box.min.z(), world_from_base.translation().z());
  if (box.empty()) {
    throw std::invalid_argument("--arm " + request.arm +
                                (chain.capsules().empty() ? " has no collision shapes" : " hangs below its --base") +
                                ", so there is no space to declare clear at its start");
  }
  return box;
}

Settings settings_for(const SearchRequest& request) {
  Settings settings;
  if (request.run.planner == "frontier-void") {  // a search ends where no view sees a void
    settings = {{"mode", "searching"}};
  }
  for (const auto& [name, value] : settings_of(request.run)) {
    settings.insert_or_assign(name, value);
  }
  return settings;
}

std::unique_ptr<ExplorationPlanner> planner_of(const SearchRequest& request, const std::shared_ptr<const Arm>& arm,
                                               const PlannerSetup& setup) {
  if (request.run.planner != ExhaustivePlanner::kName) {
    return make_planner(request.run.planner, setup, settings_for(request));
  }
  double least_view_m3 = FrontierVoidStrategy::searching().least_view_m3;
  for (const auto& [name, value] : settings_of(request.run)) {
    if (name != "least_view_m3") {
      throw std::invalid_argument("the planner exhaustive has one setting, least_view_m3, not '" + name + "'");
    }
    const std::vector<double> numbers = numbers_of("--set least_view_m3", value);
    if (numbers.size() != 1 || numbers.front() < 0.0) {
      throw std::invalid_argument("--set least_view_m3=" + value + ": must be one number >= 0");
    }
    least_view_m3 = numbers.front();
  }
  return std::make_unique<ExhaustivePlanner>(arm, setup, least_view_m3);
}

double litres(double cells, double cell_m) { return cells * std::pow(10.0 * cell_m, 3); }

// Prints a view like a row of the tables of Dornhege & Kleiner 2011.
void print_view(std::ostream& out, const ViewRecord& view, double cell_m) {
  char line[160];
  std::snprintf(line, sizeof line, "view %3zu  integration %7.1f ms  search %8.1f ms  %6.0f void cells  %7.2f dm^3\n",
                view.view, view.insert_ms, view.plan_ms, view.utility, litres(view.utility, cell_m));
  out << line << std::flush;
}

ExplorationRunOptions options_of(const ExploreRequest& shared, const World& world,
                                 const std::vector<Box>& declared_clear) {
  ExplorationRunOptions options;
  options.map.resolution_m = shared.resolution_m;
  options.map.region = region_of(shared).value_or(world.region);
  options.map.max_bytes = max_bytes_of(shared.memory_limit_mb);
  check_region(shared, world, *options.map.region);
  options.max_views = shared.max_views;
  options.scan_spacing_m = 0.0;
  options.seed = shared.seed;
  options.noise = noise_of(shared);
  options.threads = shared.threads;
  options.measure_coverage = false;
  options.unknown_box = world.searched;
  options.declared_clear = declared_clear;
  return options;
}

// NOLINTNEXTLINE(readability-function-size): a run from its options to its files
int search(const SearchRequest& request) {
  Interruption interruption;
  const ExploreRequest& shared = request.run;
  check_numbers(shared);
  check_targets(shared.out, shared.json);
  detail::require_option(request.clear_m >= 0.0 && request.clear_m <= 100.0, "--clear", request.clear_m,
                         "in [0, 100] metres");
  const RangeSensor sensor = sensor_of(shared);
  const KinematicChain chain = chain_of(request);
  const Joints joints = start_joints(request, chain);
  ArmOptions arm_options;
  arm_options.world_from_base = base_of(request);
  arm_options.declared_clear = {body_at(request, chain, arm_options.world_from_base, joints)};
  arm_options.seed = shared.seed;
  const std::shared_ptr<const Arm> arm = arm_of(request, chain, arm_options);
  const PlannerSetup setup{.sensor = sensor, .platform = arm, .seed = shared.seed, .threads = shared.threads};
  const auto planner = planner_of(request, arm, setup);
  const World world = world_of(shared);
  if (world.plan) {
    throw std::invalid_argument("--world " + shared.world + ": an arm cannot search a plane");
  }
  if (!shared.quiet) {
    std::cerr << doubts_about_world(shared, world.mesh.bounds());
  }

  ExplorationRunOptions options = options_of(shared, world, arm_options.declared_clear);
  options.stop = [&interruption] { return interruption.asked(); };
  ExplorationRun run(world, sensor, arm, options);
  const Pose start = arm->sensor_pose(joints);
  naming("--base " + request.base + (request.joints.empty() ? "" : " and --joints " + request.joints),
         [&] { run.check_start(start); });

  ProgressStream told(shared);
  std::ostream& progress = told.stream();
  RunPrinter printer(progress, told.is_terminal(), {.count = shared.max_views, .at_most = true});
  RunRecording recording(*planner, shared.out, recorder_setup(shared, "search", shared.world, sensor));
  PlanPictures pictures;
  std::optional<OccupancyMap> first_map;
  const auto on_view = [&](const ViewRecord& view, const OccupancyMap& map) {
    if (view.view == 1) {
      interruption.hold();
      printer.head(shared.planner, shared.world, shared.sensor, shared.resolution_m, shared.seed);
    }
    if (told.is_terminal()) {
      printer.view(view);
    } else {
      print_view(progress, view, shared.resolution_m);
    }
    recording.look(view, map);
    if (request.bound > 0 && !first_map) {
      first_map = map;
    }
    if (view.plan_ms > 0.0 && !shared.out.empty()) {
      pictures.look(*planner, map, view);
    }
  };
  RunRecord record = run.run(recording, start, on_view);
  record.command = "search";
  record.world = shared.world;
  printer.summary(record);
  recording.finish(record);
  if (request.exhaustive && !interruption.asked()) {
    print_exhaustive(progress, *arm, sensor, run.map());
  }
  if (first_map && !interruption.asked()) {
    const Truth truth(world, shared.resolution_m, *options.map.region);
    const ViewsNeeded needed =
        views_needed(*arm, sensor, *first_map, truth.map(), TriangleScene(world.mesh), request.bound, shared.threads);
    print_views_needed(progress, needed, shared.resolution_m);
  }
  write_outputs(shared.out, shared.json, record, run.map(), sensor, pictures.pictures(), progress, recording);
  return exit_code_of(record.outcome, interruption);
}

void add_arm_options(CLI::App& command, SearchRequest& request) {
  const auto option = [&](const char* name, auto& value, const char* type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->capture_default_str()->group("Robot");
  };
  option("--arm", request.arm, "tracked|FILE.urdf", "The arm: the one built in has five joints and reaches 1 m");
  option("--links", request.links, "BASE,SENSOR", "First and last link of the arm");
  option("--base", request.base, "x,y,z[,yaw]", "Pose of the base of the arm, metres and degrees");
  option("--joints", request.joints, "DEG,DEG,...", "Joint values at the start; default: the sensor looks forward");
  option("--clear", request.clear_m, "M", "Space around the arm at its start that is declared clear, metres")
      ->check(a_number());
  option("--sensor", request.run.sensor, "NAME|FILE.json", "A name (vantage list) or a file");
  option("--noise", request.run.noise, "X", "Depth noise, as a multiple of a Kinect's")->check(a_number());
}

}  // namespace

void add_search_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("search", "Let a simulated sensor on an arm search the voids of a known world");
  const auto request = std::make_shared<SearchRequest>();
  ExploreRequest& run = request->run;
  command->add_option("--world", run.world, "A name (vantage list), a mesh, or an OctoMap; required")
      ->required()
      ->type_name("NAME|FILE")
      ->group("World");
  add_mesh_options(*command, run, "World");
  command->add_option("--region", run.region, "Box to search, metres; default: the whole world")
      ->type_name("x0,y0,z0,x1,y1,z1")
      ->group("World");
  add_arm_options(*command, *request);
  command
      ->add_option("--planner", run.planner,
                   "A name (vantage list), or exhaustive, which scores thousands of poses for every view")
      ->type_name("NAME")
      ->capture_default_str()
      ->group("Run");
  add_setting_option(*command, run, "A setting of the planner, as often as needed; a wrong key lists them");
  add_run_options(*command, run);
  command
      ->add_flag("--exhaustive", request->exhaustive,
                 "At the end, count the void cells that thousands of poses of the arm could still see; slow")
      ->group("Run");
  command
      ->add_option("--bound", request->bound,
                   "At the end, bound the views needed with full knowledge, over so many poses; slow")
      ->type_name("POSES")
      ->check(a_whole_number(1'000'000))
      ->group("Run");
  add_output_options(*command, run);
  command->footer(
      "Examples:\n"
      "  vantage search --world crates-open --out crates\n"
      "  vantage search --world crates-closed --arm my_arm.urdf --links base_link,camera --exhaustive --json -\n"
      "Exit codes: 0 nothing observable is left, 2 bad input (nothing was written) or a file that cannot be\n"
      "written, 3 the views were spent, 4 something is left: frontiers where no view sees enough more of a void\n"
      "(see --set least_view_m3 and beyond_voids), or what cannot be reached, 130 and 143 interrupted.");
  command->callback([request, &exit_code] { exit_code = search(*request); });
}

}  // namespace vantage::apps
