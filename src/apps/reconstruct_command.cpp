// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/mesh_file.hpp>
#include <vantage/sim/object_scene.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "apps/commands.hpp"
#include "apps/explore_request.hpp"
#include "apps/help_format.hpp"
#include "apps/mesh_doubts.hpp"
#include "apps/object_run.hpp"
#include "apps/observable_progress.hpp"
#include "apps/progress_stream.hpp"
#include "apps/run_files.hpp"
#include "apps/run_printer.hpp"
#include "apps/run_recording.hpp"
#include "apps/shared_options.hpp"

namespace vantage::apps {
namespace {

// Options of `vantage reconstruct` as typed.
struct ReconstructRequest {
  std::string object;
  std::string place;
  bool table = false;
  std::string object_box;
  std::string reference;
  double gap_m = 0.0;
  std::string method = "default";
  std::uint64_t candidates = 320;
  std::string radii;
  std::uint64_t aimed = 320;
  std::optional<double> max_path_m;
  ExploreRequest run;  // options that the commands share

  ReconstructRequest() {
    run.planner = "next-best-view";
    run.sensor = "vpl";
    run.resolution_m = 0.02;
    run.robot_radius_m = 0.05;
    run.max_views = 50;
  }
};

constexpr std::uint64_t kMostCandidates = 1'000'000;
constexpr std::uint64_t kMostAimed = 10'000;  // scored after every scan, about a millisecond each
constexpr double kMostBodyCells = 100.0;      // radius; the time of a plan grows with its cube

// The object at its place: as given, in the middle of the table, or where its file has it.
TriangleMesh placed_object(const ReconstructRequest& request) {
  const TriangleMesh mesh = read_mesh_file(request.object, mesh_options_of(request.run));
  double scale = 1.0;
  Pose pose = Pose::Identity();
  if (!request.place.empty()) {
    const std::vector<double> n = numbers_of("--place", request.place);
    if (n.size() != 8) {
      throw std::invalid_argument("--place has " + std::to_string(n.size()) +
                                  " numbers, must be scale,x,y,z,qx,qy,qz,qw");
    }
    const Eigen::Quaterniond turn(n[7], n[4], n[5], n[6]);
    detail::require_option(n[0] >= 1e-6, "the scale of --place", n[0], "in [1e-6, 1e6]");
    if (turn.norm() < 1e-6) {
      throw std::invalid_argument("--place " + request.place + ": the quaternion is zero");
    }
    scale = n[0];
    pose = Eigen::Translation3d(n[1], n[2], n[3]) * turn.normalized();
  } else if (request.table) {
    const Box bounds = mesh.bounds();
    pose.translation() = Eigen::Vector3d(-bounds.centre().x(), -bounds.centre().y(), kTableTopM - bounds.min.z());
  }
  TriangleMesh placed;
  placed.append(mesh, pose, scale);
  return placed;
}

// Radii of the shells of candidates, metres; empty: the default of the scene.
std::vector<double> radii_of(const ReconstructRequest& request) {
  if (request.radii.empty()) {
    return {};
  }
  std::vector<double> radii_m = numbers_of("--radius", request.radii);
  for (const double radius_m : radii_m) {
    detail::require_option(radius_m > 0.0 && radius_m <= 1000.0, "--radius", radius_m, "> 0 and at most 1000 metres");
  }
  return radii_m;
}

// Reads rows of x y z, metres.
std::vector<Eigen::Vector3d> points_in(const std::string& path) {
  std::ifstream file(path);
  if (!file || !std::filesystem::is_regular_file(path)) {
    throw std::runtime_error("--reference " + path + ": is no file that can be read");
  }
  std::vector<double> numbers;
  for (double number = 0.0; file >> number;) {
    numbers.push_back(number);
  }
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  if (points.empty() || !file.eof() || numbers.size() % 3 != 0) {
    throw std::runtime_error("--reference " + path + ": is not a list of points, x y z in every line");
  }
  return points;
}

// If the number of candidates is 20 * 4^n, they are the faces of an icosahedron; any other number is drawn at
// random.
Settings settings_for(const ReconstructRequest& request, const ObjectScene& scene) {
  int subdivisions = 0;
  std::uint64_t faces = 20;
  for (; subdivisions < 6 && faces < request.candidates; faces *= 4) {
    ++subdivisions;
  }
  Settings settings = planner_settings(scene);
  settings.insert_or_assign("method", request.method);
  settings.insert_or_assign("subdivisions", faces == request.candidates ? std::to_string(subdivisions) : "-1");
  settings.insert_or_assign("random_candidates",
                            faces == request.candidates ? "0" : std::to_string(request.candidates));
  settings.insert_or_assign("aimed_candidates", std::to_string(request.aimed));
  for (const auto& [name, value] : settings_of(request.run)) {
    settings.insert_or_assign(name, value);
  }
  return settings;
}

// NOLINTNEXTLINE(readability-function-size): a run from its options to its files
int reconstruct(const ReconstructRequest& request) {
  Interruption interruption;
  const ExploreRequest& shared = request.run;
  check_numbers(shared);
  check_targets(shared.out, shared.json);
  detail::require_option(request.candidates > 0 && request.candidates <= kMostCandidates, "--candidates",
                         request.candidates, "in [1, 1000000]");
  detail::require_option(request.aimed <= kMostAimed, "--aimed", request.aimed, "at most 10000");
  const std::vector<double> radii_m = radii_of(request);
  detail::require_option(request.max_path_m.value_or(1.0) > 0.0, "--max-path", request.max_path_m.value_or(1.0),
                         "> 0");
  detail::require_option(request.gap_m >= 0.0 && request.gap_m <= 1000.0, "--gap", request.gap_m,
                         "in [0, 1000] metres");
  if (shared.planner != "next-best-view" && !shared.settings.empty()) {
    throw std::invalid_argument("--set: --planner " + shared.planner + " has no settings");
  }
  detail::require_option(shared.robot_radius_m <= kMostBodyCells * shared.resolution_m, "--robot-radius",
                         shared.robot_radius_m, "at most 100 cells of --resolution");
  const RangeSensor sensor = sensor_of(shared);
  const TriangleMesh object = placed_object(request);
  if (!shared.quiet && shared.scale.value_or(1.0) == 1.0) {
    std::cerr << doubt_about_object_unit(request.object, object.bounds());
  }
  const std::optional<Pose> typed = start_of(shared);
  ObjectSceneOptions placing{.name = request.object,
                             .table = request.table,
                             .radii_m = radii_m,
                             .resolution_m = shared.resolution_m,
                             .body_radius_m = shared.robot_radius_m};
  if (typed) {
    placing.start = typed->translation();
  }
  if (!request.object_box.empty()) {
    placing.object_box = box_of("--object-box", request.object_box);
    const Box bounds = object.bounds();
    if ((placing.object_box->min.array() > bounds.max.array()).any() ||
        (placing.object_box->max.array() < bounds.min.array()).any()) {
      throw std::invalid_argument("--object-box " + request.object_box + " holds nothing of the object");
    }
  }
  const ObjectScene scene = object_scene(object, sensor, placing);
  if (scene.world.region.empty()) {
    throw std::invalid_argument("--place " + request.place + " puts the object outside of the room of --table");
  }
  check_cells("--object " + request.object, true, scene.world.region, shared.resolution_m);
  const auto platform = std::make_shared<const FreeFlyer>(
      FreeFlyerOptions{.radius_m = shared.robot_radius_m, .yaw_only = shared.yaw_only});

  ExplorationRunOptions options = object_run_options(shared, scene, object);
  options.body_radius_m = shared.robot_radius_m;
  options.max_path_m = request.max_path_m;
  options.threads = shared.threads;
  options.stop = [&interruption] { return interruption.asked(); };
  ObservableProgress observable(shared.quiet);
  options.on_observable_share = [&](double share) { observable.tell(share); };
  if (request.reference.empty()) {
    for (const SurfaceSample& sample : options.object_surface) {
      options.surface_samples.push_back(sample.point);
    }
  } else {
    options.surface_samples = points_in(request.reference);
  }
  options.surface_gap_m = request.gap_m > 0.0         ? request.gap_m
                          : request.reference.empty() ? shared.resolution_m
                                                      : options.surface_gap_m;
  ExplorationRun run(scene.world, sensor, platform, options);
  const ObjectRunPlanner made = object_run_planner(
      shared, {.sensor = sensor, .platform = platform, .seed = shared.seed, .threads = shared.threads}, scene, run,
      options.object_surface, settings_for(request, scene));
  if (typed) {
    naming("--start " + shared.start, [&] { run.check_start(*typed); });
  }
  std::optional<Pose> start = typed ? typed : made.first_view;
  start = start ? start : draw_first_view(scene, run.truth(), *platform, shared.seed);

  ProgressStream told(shared);
  std::ostream& progress = told.stream();
  RunPrinter printer(progress, told.is_terminal());
  RunRecording recording(*made.planner, shared.out, recorder_setup(shared, "reconstruct", request.object, sensor));
  RunRecord record = run.run(recording, *start, [&](const ViewRecord& view, const OccupancyMap& map) {
    if (view.view == 1) {
      interruption.hold();
      printer.head(shared.planner, request.object, shared.sensor, shared.resolution_m, shared.seed);
    }
    printer.view(view);
    recording.look(view, map);
  });
  record.command = "reconstruct";
  printer.summary(record);
  if (record.coverage) {
    printer.observable(observable.seconds());
  }
  recording.finish(record);
  progress << recording.cost(record);
  write_outputs(shared.out, shared.json, record, run.map(), sensor, {}, progress, recording);
  return exit_code_of(record.outcome, interruption);
}

void add_object_options(CLI::App& command, ReconstructRequest& request) {
  const auto option = [&](const char* name, auto& value, const char* type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->group("Object");
  };
  option("--object", request.object, "FILE", "Mesh of the object; required")->required();
  add_mesh_options(command, request.run, "Object");
  option("--place", request.place, "scale,x,y,z,qx,qy,qz,qw",
         "Pose of the object; default: the middle of the table, or as in the file");
  command
      .add_flag("--table", request.table,
                "Object on the table of Vasquez-Gomez et al. in their empty room; default: in free space")
      ->group("Object");
  option("--object-box", request.object_box, "x0,y0,z0,x1,y1,z1",
         "Box to reconstruct, unknown at first, metres; all else is known. Default: 3 cm around the object");
  option("--reference", request.reference, "FILE",
         "Surface points to measure coverage by, x y z per line; default: drawn from the mesh");
  option("--gap", request.gap_m, "M",
         "A point with a return within this distance is measured; 0: one cell, or 5 mm with --reference")
      ->check(a_number())
      ->capture_default_str();
}

void add_view_options(CLI::App& command, ReconstructRequest& request) {
  ExploreRequest& run = request.run;
  const auto option = [&](const char* name, auto& value, const char* type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->capture_default_str()->group("Views");
  };
  option("--planner", run.planner, "NAME",
         "next-best-view; or to compare with: evenly-spaced (--max-views of them), furthest-view, random-views, and "
         "oracle-greedy, which knows the truth");
  option("--method", request.method, "default|hierarchical|uniform",
         "default: by the surface that a view would show first; others: the paper's counts of unknown cells");
  option("--candidates", request.candidates, "N",
         "Number of candidate views: 20, 80, 320 or 1280 evenly around the object; any other: random in the room")
      ->check(a_whole_number());
  option("--radius", request.radii, "M[,M...]",
         "Distances of the candidates from the middle of the box, metres; --candidates views at each. Default: "
         "where the box fits into the image");
  option("--aimed", request.aimed, "N", "Number of further candidates after every scan, aimed at unseen surface")
      ->check(a_whole_number());
  option("--start", run.start, "x,y,z[,yaw[,pitch]]",
         "First pose of the sensor, metres and degrees; default: drawn from the seed, with much of the box in view");
  add_sensor_options(command, run, "Views");
}

}  // namespace

void add_reconstruct_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("reconstruct", "Let a simulated sensor view an object until nothing of it is left to see");
  const auto request = std::make_shared<ReconstructRequest>();
  add_object_options(*command, *request);
  add_view_options(*command, *request);
  add_setting_option(*command, request->run, "A setting of the planner next-best-view; a wrong key lists them");
  add_coverage_option(*command, request->run);
  add_run_options(*command, request->run);
  command
      ->add_option("--max-path", request->max_path_m,
                   "The run ends before the path gets longer than this, metres; default: no limit")
      ->type_name("M")
      ->check(a_number())
      ->group("Run");
  add_output_options(*command, request->run);
  command->footer(
      "Examples:\n"
      "  vantage reconstruct --object bunny.ply --table --out bunny\n"
      "  vantage reconstruct --object cup.obj --up y --candidates 1280 --method uniform --json cup.json\n"
      "A setting of the paper's utility (gain, min_unknown_cells ...) asks for that utility.\n"
      "Exit codes: 0 no view would show enough that is new, 2 bad input (nothing was written) or a file that\n"
      "cannot be written, 3 the views were spent, 4 something is left that cannot be reached, or may be left after\n"
      "the last view of a fixed order, 130 and 143 interrupted.");
  command->callback([request, &exit_code] { exit_code = reconstruct(*request); });
}

}  // namespace vantage::apps
