// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vantage/planner/make_planner.hpp>
#include <vector>

namespace vantage::detail {

/// The valid range of a number. An option may be infinite if the range has no bound there; a text only if the default
/// is infinite.
struct SettingRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_itself = true;  ///< false: `least` itself is excluded

  [[nodiscard]] bool holds(double value) const {
    return (least_itself ? value >= least : value > least) && value <= most;
  }
  /// The range as text for error messages, e.g. "in [0, 1]".
  [[nodiscard]] std::string rule() const;
};

[[nodiscard]] inline SettingRange at_least(double least) { return {least}; }
[[nodiscard]] inline SettingRange more_than(double least) {
  return {least, std::numeric_limits<double>::infinity(), false};
}
[[nodiscard]] inline SettingRange within(double least, double most) { return {least, most}; }

/// The settings of one options struct. Each row parses, validates and documents one setting.
///
///     const SettingTable<FrontierGainOptions> table = SettingTable<FrontierGainOptions>("FrontierGainOptions")
///         .number("hypotheses", "", "random poses tried per plan", at_least(1),
///                 [](auto& options) -> auto& { return options.hypotheses; });
template <class Options>
class SettingTable {
 public:
  /// `owner` is the name of the struct, for error messages.
  explicit SettingTable(std::string_view owner) : owner_(owner) {}

  /// Adds a number; `field(options)` returns a reference to it.
  template <class Field>
  SettingTable& number(std::string_view name, std::string_view unit, std::string_view meaning, SettingRange range,
                       Field field) {
    using Number = std::remove_cvref_t<decltype(field(std::declval<Options&>()))>;
    const std::string option = std::string(owner_) + "::" + std::string(name);
    const auto otherwise = static_cast<double>(field(defaults_));
    rows_.push_back({{std::string(name), printed(field(defaults_)), std::string(unit), std::string(meaning)},
                     std::is_integral_v<Number> ? "a whole number" : "a finite number",
                     [field, otherwise](Options& options, const std::string& text) {
                       const auto [end, error] =
                           std::from_chars(text.data(), text.data() + text.size(), field(options));
                       const auto value = static_cast<double>(field(options));
                       return error == std::errc{} && end == text.data() + text.size() &&
                              (std::isfinite(value) || value == otherwise);
                     },
                     [field, range, option](const Options& options) {
                       Options copy = options;
                       const Number value = field(copy);
                       if (!range.holds(static_cast<double>(value))) {
                         throw std::invalid_argument(option + " is " + printed(value) + ", must be " + range.rule());
                       }
                     }});
    return *this;
  }
  /// Adds a setting that is true or false.
  template <class Field>
  SettingTable& flag(std::string_view name, std::string_view meaning, Field field) {
    const bool on = field(defaults_);
    return choice<bool>(name, meaning, {{on ? "true" : "false", on}, {on ? "false" : "true", !on}}, field);
  }
  /// Adds a choice between named values; the first must be the default.
  template <class Value, class Field>
  SettingTable& choice(std::string_view name, std::string_view meaning,
                       std::vector<std::pair<std::string_view, Value>> values, Field field) {
    std::string names;
    for (const auto& [value_name, value] : values) {
      names += (names.empty() ? "" : ", ") + std::string(value_name);
    }
    rows_.push_back({{std::string(name), std::string(values.front().first), "", std::string(meaning)},
                     "one of " + names,
                     [field, values](Options& options, const std::string& text) {
                       for (const auto& [value_name, value] : values) {
                         if (value_name == text) {
                           field(options) = value;
                           return true;
                         }
                       }
                       return false;
                     },
                     [](const Options&) {}});
    return *this;
  }
  /// Adds any other setting. `parse(options, text)` returns whether the text is valid; `rule` describes valid texts.
  SettingTable& text(std::string_view name, std::string_view unit, std::string_view meaning, std::string rule,
                     std::function<bool(Options&, const std::string&)> parse) {
    rows_.push_back({{std::string(name), "", std::string(unit), std::string(meaning)},
                     std::move(rule),
                     std::move(parse),
                     [](const Options&) {}});
    return *this;
  }

  /// All settings, in the order of the table.
  [[nodiscard]] std::vector<PlannerSetting> list() const {
    std::vector<PlannerSetting> all;
    for (const Row& row : rows_) {
      all.push_back(row.setting);
    }
    return all;
  }
  /// Applies the given settings in the order of the table. Throws std::invalid_argument if a setting is not in the
  /// table or its text is invalid.
  void read(std::string_view planner, const PlannerSettings& settings, Options& options) const {
    for (const auto& given : settings) {
      const std::string& name = given.first;
      if (std::none_of(rows_.begin(), rows_.end(), [&](const Row& row) { return row.setting.name == name; })) {
        std::string names;
        for (const Row& row : rows_) {
          names.append(names.empty() ? "" : ", ").append(row.setting.name);
        }
        throw std::invalid_argument(std::string("planner '")
                                        .append(planner)
                                        .append("' has no setting '")
                                        .append(name)
                                        .append("'; it has: ")
                                        .append(names));
      }
    }
    for (const Row& row : rows_) {
      const auto given = settings.find(row.setting.name);
      if (given != settings.end() && !row.parse(options, given->second)) {
        throw std::invalid_argument("planner '" + std::string(planner) + "': setting '" + row.setting.name +
                                    "' is '" + given->second + "', must be " + row.kind);
      }
    }
  }
  /// Throws std::invalid_argument, which names the first option outside its range.
  void validate(const Options& options) const {
    for (const Row& row : rows_) {
      row.check(options);
    }
  }

 private:
  struct Row {
    PlannerSetting setting;
    std::string kind;
    std::function<bool(Options&, const std::string&)> parse;
    std::function<void(const Options&)> check;
  };
  template <class Number>
  static std::string printed(Number value) {
    std::array<char, 64> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
  }

  std::string_view owner_;
  Options defaults_ = {};
  std::vector<Row> rows_;
};

inline std::string SettingRange::rule() const {
  const auto number = [](double value) {
    std::array<char, 64> digits{};
    return std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  };
  if (std::isfinite(most)) {
    return (least_itself ? "in [" : "in (") + number(least) + ", " + number(most) + "]";
  }
  return (least_itself ? ">= " : "> ") + number(least);
}

}  // namespace vantage::detail
