// SPDX-License-Identifier: MIT
#pragma once

#include "apps/explore_request.hpp"

namespace CLI {
class App;
}

// Options that several commands have: added, checked and described once.
namespace vantage::apps {

/// Adds --up and --scale under this heading of the help.
void add_mesh_options(CLI::App& command, ExploreRequest& request, const char* group);
/// Adds --sensor, --robot-radius and --noise under this heading of the help.
void add_sensor_options(CLI::App& command, ExploreRequest& request, const char* group);
/// Adds --set; `about` says whose settings they are.
void add_setting_option(CLI::App& command, ExploreRequest& request, const char* about);
/// Adds --no-coverage.
void add_coverage_option(CLI::App& command, ExploreRequest& request);
/// Adds --resolution, --max-views, --memory-limit, --seed and --threads.
void add_run_options(CLI::App& command, ExploreRequest& request);
/// Adds --out, --json and --quiet.
void add_output_options(CLI::App& command, ExploreRequest& request);

}  // namespace vantage::apps
