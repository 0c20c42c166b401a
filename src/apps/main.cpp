// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

#include "apps/commands.hpp"

namespace {

// Printed text may still be buffered; a full disk or a closed reader shows here at the latest.
void check_stdout() {
  std::cout.flush();
  if (!std::cout) {
    throw std::runtime_error("stdout: not all could be written to it");
  }
}

// CLI11's words for an option that is given more than once are replaced.
std::string message_of(const CLI::ArgumentMismatch& error) {
  const std::string message = error.what();
  const std::string repeated = ": At Most 1 required but received ";
  const std::size_t at = message.find(repeated);
  if (at == std::string::npos) {
    return message;
  }
  const std::string times = message.substr(at + repeated.size());
  return message.substr(0, at) + " is given " + (times == "2" ? "twice" : times + " times") + ", must be given once";
}

}  // namespace

int main(int argc, char** argv) {
  (void)std::signal(SIGPIPE, SIG_IGN);  // the stream reports the error
  CLI::App app("Where should a robot's 3D sensor look next?", "vantage");
  int exit_code = vantage::apps::kDone;
  vantage::apps::add_commands(app, exit_code);
  try {
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& request) {
      exit_code = app.exit(request);  // --help, --version
    }
    check_stdout();
    return exit_code;
  } catch (const CLI::ArgumentMismatch& error) {
    std::cerr << "vantage: " << message_of(error) << '\n';
    return vantage::apps::kBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "vantage: there is not enough memory for this\n";
    return vantage::apps::kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "vantage: " << vantage::apps::one_line(error.what()) << '\n';
    return vantage::apps::kBadInput;
  }
}
