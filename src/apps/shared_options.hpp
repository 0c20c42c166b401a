// SPDX-License-Identifier: MIT
#pragma once

#include "apps/explore_request.hpp"

namespace CLI {
class App;
}

// Options that several commands have; each is asked for, checked and explained once.
namespace vantage::apps {

/// --sensor, --robot-radius and --noise, under this heading of the help.
void add_sensor_options(CLI::App& command, ExploreRequest& request, const char* group);
/// --set; `about` says whose settings they are.
void add_setting_option(CLI::App& command, ExploreRequest& request, const char* about);
/// --resolution, --max-views, --seed and --threads.
void add_run_options(CLI::App& command, ExploreRequest& request);
/// --out, --json and --quiet.
void add_output_options(CLI::App& command, ExploreRequest& request);

}  // namespace vantage::apps
