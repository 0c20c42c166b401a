// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {  // NOLINT(readability-identifier-naming): named by CLI11
class App;
}

namespace vantage::apps {

/// Adds `vantage report`: the page, the report and the exports of one record.
void add_report_command(CLI::App& app);
/// Adds `vantage compare`: several reports side by side.
void add_compare_command(CLI::App& app);
/// Adds `vantage evaluate`: tables of planners beside their peers.
void add_evaluate_command(CLI::App& app, int& exit_code);

}  // namespace vantage::apps
