// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>

namespace vantage::apps {

/// Layout of `--help`: the kind of an option's value beside its name, the default after its description.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();

  [[nodiscard]] std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  [[nodiscard]] std::string make_usage(const CLI::App* app, std::string name) const override;
  [[nodiscard]] std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;
};

// Checks of typed values, with a message for a person; CLI11 puts the name of the option before it.
[[nodiscard]] CLI::Validator a_number();
[[nodiscard]] CLI::Validator a_whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

}  // namespace vantage::apps
