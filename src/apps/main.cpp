// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "apps/commands.hpp"

int main(int argc, char** argv) {
  CLI::App app("Where should a robot's 3D sensor look next?", "vantage");
  int exit_code = vantage::apps::kDone;
  vantage::apps::add_commands(app, exit_code);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& request) {
    return app.exit(request);  // --help, --version
  } catch (const std::exception& error) {
    std::cerr << "vantage: " << vantage::apps::one_line(error.what()) << '\n';
    return vantage::apps::kBadInput;
  }
}
