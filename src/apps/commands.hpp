// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/report/run_record.hpp>

#include "apps/interruption.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): named by CLI11
class App;
}

namespace vantage::apps {

// Exit codes of every command; of one that a signal ended, see Interruption.
inline constexpr int kDone = 0;
inline constexpr int kBadInput = 2;  // said in one line on stderr, nothing written; or what cannot be written
inline constexpr int kBudget = 3;    // a budget ended the run
inline constexpr int kLeftOver = 4;  // it ended with something left: unreachable, blocked

/// Adds every command; one that runs puts its exit code into `exit_code`, or throws for bad input.
void add_commands(CLI::App& app, int& exit_code);

void add_explore_command(CLI::App& app, int& exit_code);
void add_list_command(CLI::App& app);
void add_reconstruct_command(CLI::App& app, int& exit_code);
void add_search_command(CLI::App& app, int& exit_code);  // where there is vantage::arm
void add_replay_command(CLI::App& app, int& exit_code);

/// Of a run that ended so.
[[nodiscard]] int exit_code_of(RunOutcome outcome, const Interruption& interruption);

/// `message` without line breaks.
[[nodiscard]] std::string one_line(std::string message);

}  // namespace vantage::apps
