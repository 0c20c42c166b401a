// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/report/run_record.hpp>

#include "apps/interruption.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): named by CLI11
class App;
}

namespace vantage::apps {

// Exit codes of every command. For a command that a signal ended see Interruption.
inline constexpr int kDone = 0;
inline constexpr int kBadInput =
    2;  // bad input, one line on stderr and nothing written; or a file or stdout that cannot be written
inline constexpr int kBudget = 3;    // the budget ended the run
inline constexpr int kLeftOver = 4;  // the run ended with something left: unreachable or blocked

/// Adds every command. A command that runs sets `exit_code`, or throws for bad input.
void add_commands(CLI::App& app, int& exit_code);

void add_explore_command(CLI::App& app, int& exit_code);
void add_list_command(CLI::App& app);
void add_reconstruct_command(CLI::App& app, int& exit_code);
void add_search_command(CLI::App& app, int& exit_code);  // only built with vantage::arm
void add_replay_command(CLI::App& app, int& exit_code);

/// The exit code of a run that ended with `outcome`.
[[nodiscard]] int exit_code_of(RunOutcome outcome, const Interruption& interruption);

/// `message` without line breaks.
[[nodiscard]] std::string one_line(std::string message);

}  // namespace vantage::apps
