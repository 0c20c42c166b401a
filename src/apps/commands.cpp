// SPDX-License-Identifier: MIT
#include "apps/commands.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vantage/version.hpp>
#include <vector>

#include "apps/explore_request.hpp"
#include "apps/help_format.hpp"
#include "apps/map_command.hpp"
#include "apps/report_commands.hpp"

namespace vantage::apps {
namespace {

struct MapRequest {
  std::string file;
  std::string json;
  double memory_limit_mb = 0.0;
};

void add_map_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("map", "Tell the size of an OctoMap file and its cells by kind");
  const auto request = std::make_shared<MapRequest>();
  command->add_option("FILE", request->file, "The map, as OctoMap writes it")
      ->required()
      ->type_name("FILE.bt|FILE.ot");
  command->add_option("--json", request->json, "File for the same as JSON; -: to stdout")->type_name("FILE|-");
  command
      ->add_option("--memory-limit", request->memory_limit_mb,
                   "A map that needs more is refused, 10^6 bytes; 0: no limit")
      ->type_name("MB")
      ->check(a_number());
  command->footer(
      "Examples:\n"
      "  vantage map rooms/map.ot\n"
      "  vantage map geb079.bt --json -");
  command->callback([request, &exit_code] {
    exit_code = run_map_command(request->file, request->json, std::cout, max_bytes_of(request->memory_limit_mb));
  });
}

// Refuses what a command was given and does not take.
void check_extras(const CLI::App& command, const std::string& name) {
  const std::vector<std::string> strangers = command.remaining();
  const auto option =
      std::find_if(strangers.begin(), strangers.end(), [](const std::string& word) { return word.front() == '-'; });
  if (!strangers.empty()) {
    throw std::invalid_argument(
        name + (option != strangers.end() ? " has no option " + *option : " takes no '" + strangers.front() + "'") +
        "; what it takes: vantage " + name + " --help");
  }
  for (const CLI::App* part : command.get_subcommands()) {
    check_extras(*part, name + ' ' + part->get_name());
  }
}

// Lets check_extras word the error.
void allow_extras(CLI::App& command) {
  command.allow_extras();
  for (CLI::App* part : command.get_subcommands({})) {
    allow_extras(*part);
  }
}

// Called before any command runs.
void check_command(const CLI::App& app) {
  const std::vector<std::string> strangers = app.remaining();
  if (!strangers.empty() && strangers.front().front() == '-') {
    throw std::invalid_argument("there is no option " + strangers.front() + " before the command");
  }
  if (!strangers.empty() || app.get_subcommands().empty()) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands({})) {
      names += (names.empty() ? "" : ", ") + command->get_name();
    }
    throw std::invalid_argument(
        (strangers.empty() ? "no command was given" : "there is no command '" + strangers.front() + "'") +
        "; there are: " + names);
  }
  for (const CLI::App* command : app.get_subcommands()) {
    check_extras(*command, command->get_name());
  }
}

// `--out "$folder"` with an unset variable must not be taken for no --out.
void refuse_empty_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_expected_max() > 0) {
      option->check(CLI::Validator([](const std::string& value) { return value.empty() ? "is empty" : ""; }, ""));
    }
  }
  for (CLI::App* command : app.get_subcommands({})) {
    refuse_empty_values(*command);
  }
}

}  // namespace

void add_commands(CLI::App& app, int& exit_code) {
  app.formatter(std::make_shared<HelpFormat>());
  app.set_help_flag("-h,--help", "This text");
  app.set_version_flag("--version", "vantage " VANTAGE_VERSION_STRING, "The version");
  app.failure_message(CLI::FailureMessage::simple);
  add_explore_command(app, exit_code);
  add_reconstruct_command(app, exit_code);
  add_replay_command(app, exit_code);
#ifdef VANTAGE_WITH_ARM
  add_search_command(app, exit_code);
#endif
  add_report_command(app);
  add_compare_command(app);
  add_evaluate_command(app, exit_code);
  add_map_command(app, exit_code);
  add_list_command(app);
  refuse_empty_values(app);
  // Set last, because the commands do not inherit it.
  for (CLI::App* command : app.get_subcommands({})) {
    command->group("Commands");
  }
  allow_extras(app);
  app.require_subcommand(0, 1);  // a second one is an extra of the first; check_command tells that there is none
  app.parse_complete_callback([&app] { check_command(app); });
  app.footer(
      "What a command takes: vantage COMMAND --help\n"
      "To begin with:        vantage explore --world rooms --out rooms");
}

int exit_code_of(RunOutcome outcome, const Interruption& interruption) {
  if (interruption.asked()) {  // perhaps after the run, while its bound was sought
    return interruption.exit_code();
  }
  switch (outcome) {
    case RunOutcome::Explored:
      return kDone;
    case RunOutcome::Budget:
      return kBudget;
    case RunOutcome::Interrupted:
      return interruption.exit_code();
    default:
      return kLeftOver;
  }
}

std::string one_line(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '\r')) {
    message.pop_back();
  }
  for (char& c : message) {
    c = c == '\n' || c == '\r' ? ' ' : c;
  }
  return message;
}

}  // namespace vantage::apps
