// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/explore_request.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): named by CLI11
class App;
}

namespace vantage::apps {

/// Adds the options of `vantage explore` that make a run: world, robot, motion, planner and budget.
void add_explore_options(CLI::App& command, ExploreRequest& request);

/// What a text such as "--world rooms --seed 3" asks `vantage explore` for. Throws std::invalid_argument naming what
/// is wrong in it.
[[nodiscard]] ExploreRequest explore_request(const std::string& options);

}  // namespace vantage::apps
