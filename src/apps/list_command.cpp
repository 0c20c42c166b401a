// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <iostream>
#include <numbers>
#include <string>
#include <string_view>
#include <vantage/planner/make_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

#include "apps/commands.hpp"

namespace vantage::apps {
namespace {

std::string described(std::string_view name) {
  const RangeSensor sensor = RangeSensor::preset(name);
  char text[160];
  std::snprintf(text, sizeof text, "%4zu x %-4zu  %5.1f x %5.1f deg   %.1f to %.1f m", sensor.width, sensor.height,
                sensor.horizontal_angle_rad() * 180.0 / std::numbers::pi,
                sensor.vertical_angle_rad() * 180.0 / std::numbers::pi, sensor.min_range_m, sensor.max_range_m);
  return text;
}

void print_names(const char* title, const std::vector<std::string_view>& names) {
  std::cout << title << '\n';
  for (const std::string_view name : names) {
    std::cout << "  " << name << '\n';
  }
}

void list() {
  print_names("worlds (or a mesh file, or a .bt/.ot map)", World::names());
  print_names("planners", planner_names());
  std::cout << "sensors (or a .json file)\n";
  for (const std::string_view name : RangeSensor::preset_names()) {
    std::cout << "  " << name << std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') << described(name) << '\n';
  }
}

}  // namespace

void add_list_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "The worlds, planners and sensors known by name");
  command->callback(list);
}

}  // namespace vantage::apps
