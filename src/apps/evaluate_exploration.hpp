// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {  // NOLINT(readability-identifier-naming): named by CLI11
class App;
}

namespace vantage::apps {

/// Adds `vantage evaluate exploration` to the command evaluate.
void add_evaluate_exploration_command(CLI::App& evaluate, int& exit_code);

}  // namespace vantage::apps
