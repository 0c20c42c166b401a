// SPDX-License-Identifier: MIT
#include "apps/explore_options.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <stdexcept>

#include "apps/help_format.hpp"
#include "apps/shared_options.hpp"

namespace vantage::apps {
namespace {

void add_world_options(CLI::App& command, ExploreRequest& request) {
  command
      .add_option("--world", request.world,
                  "A name (vantage list), a mesh, an OctoMap, or a nav2 map (.yaml); required")
      ->required()
      ->type_name("NAME|FILE")
      ->group("World");
  add_mesh_options(command, request, "World");
  command.add_option("--size", request.size, "Extent of a generated world (office, maze), metres")
      ->type_name("LENGTH,WIDTH")
      ->group("World");
  command.add_option("--region", request.region, "Box to explore, metres; default: the whole world")
      ->type_name("x0,y0,z0,x1,y1,z1")
      ->group("World");
}

void add_robot_options(CLI::App& command, ExploreRequest& request) {
  command
      .add_option("--start", request.start,
                  "First pose of the sensor, metres and degrees; default: drawn from the seed")
      ->type_name("x,y,z[,yaw[,pitch]]")
      ->group("Robot");
  add_sensor_options(command, request, "Robot");
  command.add_flag("--yaw-only", request.yaw_only, "The sensor stays level")->group("Robot");
  command
      .add_option("--band", request.band,
                  "The robot drives in the plane of these heights; default SENSOR: the middle")
      ->type_name("LOW,HIGH[,SENSOR]")
      ->group("Robot");
  command
      .add_flag("--no-floor", request.no_floor,
                "With --band: it drives where no floor was seen, too; for worlds without a floor")
      ->needs("--band")
      ->group("Robot");
  command
      .add_flag("--look-around", request.look_around,
                "The robot turns once on the spot and scans before the first plan")
      ->group("Robot");
  command.add_option("--scan-spacing", request.scan_spacing_m, "Path between scans, metres; 0: scans at goals only")
      ->type_name("M")
      ->check(a_number())
      ->capture_default_str()
      ->group("Robot");
}

void add_motion_options(CLI::App& command, ExploreRequest& request) {
  const auto option = [&](const char* name, std::optional<double>& value, const char* type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->check(a_number())->group("Robot in time");
  };
  option("--max-speed", request.max_speed_m_s, "M/S", "Timed run: largest speed");
  option("--max-acceleration", request.max_acceleration_m_s2, "M/S2",
         "Largest acceleration: speeding up, braking and cornering");
  option("--max-yaw-rate", request.max_yaw_rate_deg_s, "DEG/S", "Largest turning rate");
  option("--max-yaw-acceleration", request.max_yaw_acceleration_deg_s2, "DEG/S2",
         "Largest angular acceleration; default: unlimited");
  option("--scan-rate", request.scan_rate_hz, "HZ", "Scans per second; --max-views defaults to one hour of them");
  option("--planning-latency", request.planning_latency_s, "S",
         "Time from a scan until the plan made from it takes effect")
      ->default_str("0.05");
}

}  // namespace

void add_explore_options(CLI::App& command, ExploreRequest& request) {
  add_world_options(command, request);
  add_robot_options(command, request);
  add_motion_options(command, request);
  command.add_option("--planner", request.planner, "A name (vantage list)")
      ->type_name("NAME")
      ->capture_default_str()
      ->group("Run");
  command.add_flag("--wear", request.wear, "Rays at a small angle wear away the surface they end in, as in OctoMap")
      ->group("Run");
  command
      .add_flag("--bound", request.bound,
                "At the end, find the shortest route for who knows the world, or a lower bound; slow")
      ->group("Run");
  add_coverage_option(command, request);
  command
      .add_flag("--audit", request.audit,
                "At the end, check by brute force that nothing is left that could be observed; slow")
      ->group("Run");
  add_setting_option(command, request, "A setting of the planner, as often as needed; a wrong key lists them");
  add_run_options(command, request);
}

ExploreRequest explore_request(const std::string& options) {
  ExploreRequest request;
  CLI::App app;
  add_explore_options(app, request);
  try {
    app.parse(options);
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument("'" + options + "': " + error.what());
  }
  check_numbers(request);
  return request;
}

}  // namespace vantage::apps
