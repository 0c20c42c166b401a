// SPDX-License-Identifier: MIT
#include "apps/shared_options.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>

#include "apps/help_format.hpp"

namespace vantage::apps {

void add_mesh_options(CLI::App& command, ExploreRequest& request, const char* group) {
  command.add_option("--up", request.up, "Axis of a mesh file that points up; default: from the file, otherwise z")
      ->type_name("y|z")
      ->group(group);
  command.add_option("--scale", request.scale, "Metres per unit of a mesh file")
      ->type_name("S")
      ->check(a_number())
      ->default_str("1")
      ->group(group);
}

void add_sensor_options(CLI::App& command, ExploreRequest& request, const char* group) {
  const auto option = [&](const char* name, auto& value, const char* type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->capture_default_str()->group(group);
  };
  option("--sensor", request.sensor, "NAME|FILE.json", "A name (vantage list) or a file");
  option("--robot-radius", request.robot_radius_m, "M", "The robot is a sphere about its sensor, metres")
      ->check(a_number());
  option("--noise", request.noise, "X", "Depth noise, as a multiple of a Kinect's")->check(a_number());
  option("--pose-noise", request.pose_noise, "M,DEG", "Error of the reported poses, standard deviation in each axis");
}

void add_setting_option(CLI::App& command, ExploreRequest& request, const char* about) {
  command.add_option("--set", request.settings, about)
      ->type_name("key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->group("Run");
}

void add_coverage_option(CLI::App& command, ExploreRequest& request) {
  command
      .add_flag("--no-coverage", request.no_coverage,
                "Do not measure coverage, so that the first view need not wait for it")
      ->group("Run");
}

void add_run_options(CLI::App& command, ExploreRequest& request) {
  constexpr std::uint64_t kMostThreads = 1024;
  const auto option = [&](const char* name, auto& value, const char* type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->capture_default_str()->group("Run");
  };
  option("--resolution", request.resolution_m, "M", "Edge of a cell of the map, metres")->check(a_number());
  option("--max-views", request.max_views, "N", "Scans after which the run ends")->check(a_whole_number());
  option("--memory-limit", request.memory_limit_mb, "MB",
         "Largest memory of the map; updates beyond it are refused; 0: no limit")
      ->check(a_number());
  option("--seed", request.seed, "N", "Random seed")->check(a_whole_number());
  option("--threads", request.threads, "N", "Number of threads; the result does not depend on it")
      ->check(a_whole_number(kMostThreads));
}

void add_output_options(CLI::App& command, ExploreRequest& request) {
  command.add_option("--out", request.out, "Folder for report.html, report.json, run.record, map.ot and pictures")
      ->type_name("DIR")
      ->group("Output");
  command.add_option("--json", request.json, "File for the report; -: to stdout, and all other output to stderr")
      ->type_name("FILE|-")
      ->group("Output");
  command.add_flag("-q,--quiet", request.quiet, "Print only errors")->group("Output");
}

}  // namespace vantage::apps
