// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vantage/evaluation/exploration_peers.hpp>
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
  std::snprintf(text, sizeof text, "%4zu x %-4zu %5.1f x %5.1f deg  %.1f to %4.1f m", sensor.width, sensor.height,
                sensor.horizontal_angle_rad() * 180.0 / std::numbers::pi,
                sensor.vertical_angle_rad() * 180.0 / std::numbers::pi, sensor.min_range_m, sensor.max_range_m);
  return text;
}

constexpr std::pair<std::string_view, std::string_view> kAbout[] = {
    {"rooms", "a closed cube of 10.2 m with walls and openings in it (Shade & Newman 2011)"},
    {"office", "a corridor with furnished rooms on both sides, made from the seed"},
    {"maze", "narrow passages with a few loops, made from the seed"},
    {"two-storey", "two floors of rooms joined by a stairwell"},
    {"table", "an object on a table in an otherwise empty room"},
    {"crates-open", "a computer, open boxes and planks before a robot (Dornhege & Kleiner 2011)"},
    {"crates-closed", "closed boxes and boxes with small openings, likewise"},
    {"frontier-gain", "the best of many random views, by the frontier seen from them; a baseline"},
    {"frontier-void", "the view of most void cells, through frontiers (Dornhege & Kleiner 2011)"},
    {"harmonic", "steepest descent of a harmonic field (Shade & Newman 2011)"},
    {"nearest-frontier", "the nearest place from which a frontier is seen; a baseline"},
    {"next-best-view", "the view of most unknown cells, nearness counted (Vasquez-Gomez et al. 2013)"},
    {"tour", "a tour over all frontiers known to be left, in seconds or metres"},
    {"distance-advantage", "what is far from everything else while it is near (Ericson et al. 2025)"},
    {"fuel-like", "a tour over all parts of the frontier, the first ones refined (Zhou et al. 2021)"},
    {"rh-nbv", "the best branch of a random tree of views, its first edge (Bircher et al. 2016)"},
    {"aep-like", "such a tree here, frontiers elsewhere (Selin et al. 2019)"},
    {"tare-like", "views that cover what is near, a coarse tour beyond (Cao et al. 2021)"},
    {"falcon-like", "a path over zones of free and unknown space (Zhang et al. 2024)"},
};

void print(std::string_view name, std::string_view about) {
  constexpr std::size_t kWidth = 20;
  std::cout << "  " << name << std::string(name.size() < kWidth ? kWidth - name.size() : 1, ' ') << about << '\n';
}

void print_names(const char* title, std::span<const std::string_view> names) {
  std::cout << title << '\n';
  for (const std::string_view name : names) {
    const auto* about =
        std::find_if(std::begin(kAbout), std::end(kAbout), [&](const auto& a) { return a.first == name; });
    print(name, about == std::end(kAbout) ? "" : about->second);
  }
}

void list() {
  print_names("worlds (or a mesh file, a .bt/.ot map, or a nav2 .yaml)", World::names());
  print_names("planners", planner_names());
  print_names(
      "planners to compare with (our implementations of published methods; explore and evaluate exploration only)",
      exploration_peer_names());
  std::cout << "sensors (or a .json file)\n";
  for (const std::string_view name : RangeSensor::preset_names()) {
    print(name, described(name));
  }
}

void list_settings(const std::string& planner) {
  const auto peers = exploration_peer_names();
  if (std::find(peers.begin(), peers.end(), planner) != peers.end()) {
    throw std::invalid_argument("the planner " + planner + " has no settings");
  }
  const auto settings = planner_settings(planner);
  std::cout << "settings of " << planner << " (--set name=value): name, default, unit, meaning\n";
  for (const Setting& setting : settings) {
    char text[96];
    std::snprintf(text, sizeof text, "  %-22s %-14s %-9s ", setting.name.c_str(), setting.default_value.c_str(),
                  setting.unit.c_str());
    std::cout << text << setting.meaning << '\n';
  }
}

}  // namespace

void add_list_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "Name the worlds, planners and sensors there are");
  command->footer("Example:\n  vantage list --settings harmonic");
  auto planner = std::make_shared<std::string>();
  command->add_option("--settings", *planner, "The settings of this planner instead");
  command->callback([planner] { planner->empty() ? list() : list_settings(*planner); });
}

}  // namespace vantage::apps
