// SPDX-License-Identifier: MIT
#include "apps/help_format.hpp"

#include <charconv>
#include <cstdint>
#include <string>
#include <utility>

namespace vantage::apps {
namespace {

template <class Number>
bool reads_as(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stopped == end;
}

}  // namespace

HelpFormat::HelpFormat() {
  column_width(37);
  label("Positionals", "Takes");
}

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
  for (std::size_t gap = help.find("\n\n\n"); gap != std::string::npos; gap = help.find("\n\n\n", gap)) {
    help.erase(gap, 1);
  }
  while (help.size() > 1 && help.compare(help.size() - 2, 2, "\n\n") == 0) {
    help.pop_back();
  }
  return help;
}

std::string HelpFormat::make_usage(const CLI::App* app, std::string name) const {
  std::string usage = "\nUsage: " + name;
  for (const CLI::Option* option : app->get_options([](const CLI::Option* o) { return o->get_positional(); })) {
    usage += " " + option->get_type_name();
  }
  usage += app->get_subcommands({}).empty() ? "" : " COMMAND";
  return usage + " [options]\n";
}

std::string HelpFormat::make_option_name(const CLI::Option* option, bool is_positional) const {
  return is_positional ? option->get_type_name() : CLI::Formatter::make_option_name(option, is_positional);
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  return option->get_type_size() == 0 || option->get_positional() ? "" : " " + option->get_type_name();
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  std::string standard = option->get_default_str();
  if (standard.empty()) {
    return option->get_description();
  }
  const bool is_list = standard.front() == '[';  // CLI11 puts these in brackets itself
  return option->get_description() + " " + (is_list ? standard : "[" + standard + "]");
}

CLI::Validator a_number() {
  const auto check = [](const std::string& text) {
    double number = 0.0;
    return reads_as(text, number) ? "" : "'" + text + "' is not a number";
  };
  return {check, ""};
}

CLI::Validator a_whole_number(std::uint64_t most) {
  const auto check = [most](const std::string& text) {
    std::uint64_t number = 0;
    return reads_as(text, number) && number <= most
               ? ""
               : "'" + text + "' is not a whole number from 0 to " + std::to_string(most);
  };
  return {check, ""};
}

}  // namespace vantage::apps
