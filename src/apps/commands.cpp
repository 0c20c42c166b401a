// SPDX-License-Identifier: MIT
#include "apps/commands.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <vantage/version.hpp>

#include "apps/map_command.hpp"

namespace vantage::apps {

namespace {

struct MapRequest {
  std::string file;
  std::string json;
};

void add_map_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("map", "Sizes and cell counts of an OctoMap file");
  const auto request = std::make_shared<MapRequest>();
  command->add_option("file", request->file, "The map")->required()->type_name("FILE.bt|FILE.ot");
  command->add_option("--json", request->json, "The same as JSON; -: on stdout")->type_name("FILE|-");
  command->callback([request, &exit_code] { exit_code = run_map_command(request->file, request->json, std::cout); });
}

}  // namespace

void add_commands(CLI::App& app, int& exit_code) {
  app.set_version_flag("--version", "vantage " VANTAGE_VERSION_STRING);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer("Try: vantage explore --world rooms --planner harmonic --sensor panoramic --out rooms\n"
             "Exit codes: 0 done, 2 bad input (nothing was written), 3 a budget ended the run.");
  add_explore_command(app, exit_code);
  add_map_command(app, exit_code);
  add_list_command(app);
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
