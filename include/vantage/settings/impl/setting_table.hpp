// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vantage/settings/setting.hpp>
#include <vector>

#include <vantage/settings/impl/setting_range.hpp>

namespace vantage::detail {

/// The options of one struct. Each row parses, validates and documents one of them. The pointers to members at the
/// end of a row lead to the option, from the struct inwards.
///
///     const auto table = SettingTable<HarmonicOptions>("HarmonicOptions")
///         .number("tolerance", "", "largest relative change of the last sweep", within(1e-15, 1),
///                 &HarmonicOptions::field, &HarmonicFieldOptions::tolerance)
///         .number("detour_m", "m", "further frontiers wait", at_least(0),
///                 &HarmonicOptions::strategy, &HarmonicStrategy::detour_m);
template <class Options>
class SettingTable {
 public:
  /// `owner` is the name of the struct, for error messages.
  explicit SettingTable(std::string_view owner) : owner_(owner) {}

  /// Adds a number.
  template <class... Members>
  SettingTable& number(std::string_view name, std::string_view unit, std::string_view meaning, SettingRange range,
                       Members... members) {
    auto& otherwise = at(defaults_, members...);
    constexpr bool kWhole = std::is_integral_v<std::remove_cvref_t<decltype(otherwise)>>;
    rows_.push_back({{std::string(name), printed(otherwise), std::string(unit), std::string(meaning)},
                     kWhole ? "a whole number" : "a finite number",
                     [otherwise, members...](Options& options, const std::string& text) {
                       auto& value = at(options, members...);
                       const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
                       return error == std::errc{} && end == text.data() + text.size() &&
                              (std::isfinite(static_cast<double>(value)) || value == otherwise);
                     }});
    return limit(std::string(owner_).append("::").append(name), range, members...);
  }
  /// Adds a setting that is true or false.
  template <class... Members>
  SettingTable& flag(std::string_view name, std::string_view meaning, Members... members) {
    const bool on = at(defaults_, members...);
    return choice<bool>(name, meaning, {{on ? "true" : "false", on}, {on ? "false" : "true", !on}}, members...);
  }
  /// Adds a choice between named values; the first must be the default.
  template <class Value, class... Members>
  SettingTable& choice(std::string_view name, std::string_view meaning,
                       const std::vector<std::pair<std::string_view, Value>>& values, Members... members) {
    rows_.push_back({{std::string(name), std::string(values.front().first), "", std::string(meaning)},
                     "one of " + joined(values, [](const auto& value) { return value.first; }),
                     [values, members...](Options& options, const std::string& text) {
                       const auto named = std::find_if(values.begin(), values.end(),
                                                       [&](const auto& value) { return value.first == text; });
                       if (named != values.end()) {
                         at(options, members...) = named->second;
                       }
                       return named != values.end();
                     }});
    return *this;
  }
  /// As `choice`, of values that each replace several options; so there is no default.
  template <class Value, class... Members>
  SettingTable& mode(std::string_view name, std::string_view meaning,
                     const std::vector<std::pair<std::string_view, Value>>& values, Members... members) {
    choice<Value>(name, meaning, values, members...);
    rows_.back().setting.default_value.clear();
    return *this;
  }
  /// Adds any other setting. `parse(options, text)` returns whether the text is valid; `rule` describes valid texts.
  SettingTable& text(std::string_view name, std::string_view unit, std::string_view meaning, std::string rule,
                     std::function<bool(Options&, const std::string&)> parse) {
    rows_.push_back(
        {{std::string(name), "", std::string(unit), std::string(meaning)}, std::move(rule), std::move(parse)});
    return *this;
  }
  /// The range of an option that cannot be given as text. `option` is its whole name, for error messages.
  template <class... Members>
  SettingTable& limit(std::string_view option, SettingRange range, Members... members) {
    checks_.push_back([name = std::string(option), range, members...](const Options& options) {
      const auto value = at(options, members...);
      if (!range.holds(static_cast<double>(value))) {
        throw std::invalid_argument(name + " is " + printed(value) + ", must be " + range.rule());
      }
    });
    return *this;
  }

  /// A rule that no range can say. `check(options)` throws std::invalid_argument.
  SettingTable& check(std::function<void(const Options&)> check) {
    checks_.push_back(std::move(check));
    return *this;
  }

  /// All settings, in the order of the table.
  [[nodiscard]] std::vector<Setting> list() const {
    std::vector<Setting> all;
    std::transform(rows_.begin(), rows_.end(), std::back_inserter(all), [](const Row& row) { return row.setting; });
    return all;
  }
  /// Whether there is a setting of this name.
  [[nodiscard]] bool has(std::string_view name) const {
    return std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) { return row.setting.name == name; });
  }
  /// Applies the given settings in the order of the table. Throws std::invalid_argument if a setting is not in the
  /// table or its text is invalid.
  void read(std::string_view planner, const Settings& settings, Options& options) const {
    const std::string who = "planner '" + std::string(planner) + "'";
    const auto foreign =
        std::find_if(settings.begin(), settings.end(), [&](const auto& given) { return !has(given.first); });
    if (foreign != settings.end()) {
      const std::string names = joined(rows_, [](const Row& row) { return row.setting.name; });
      throw std::invalid_argument(who + " has no setting '" + foreign->first + "'; it has: " + names);
    }
    for (const Row& row : rows_) {
      const auto given = settings.find(row.setting.name);
      if (given != settings.end() && !row.parse(options, given->second)) {
        throw std::invalid_argument(who + ": setting '" + row.setting.name + "' is '" + given->second +
                                    "', must be " + row.kind);
      }
    }
  }
  /// Throws std::invalid_argument, which names the first option outside its range.
  void validate(const Options& options) const {
    for (const auto& check : checks_) {
      check(options);
    }
  }

 private:
  struct Row {
    Setting setting;
    std::string kind;
    std::function<bool(Options&, const std::string&)> parse;
  };

  template <class Object, class Member, class... Inner>
  static auto& at(Object& object, Member member, Inner... inner) {
    if constexpr (sizeof...(inner) == 0) {
      return object.*member;
    } else {
      return at(object.*member, inner...);
    }
  }
  template <class Number>
  static std::string printed(Number value) {
    std::array<char, 64> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
  }
  template <class Items, class NameOf>
  static std::string joined(const Items& items, NameOf name_of) {
    std::string names;
    for (const auto& item : items) {
      names.append(names.empty() ? "" : ", ").append(name_of(item));
    }
    return names;
  }

  std::string_view owner_;
  Options defaults_ = {};
  std::vector<Row> rows_;
  std::vector<std::function<void(const Options&)>> checks_;
};

}  // namespace vantage::detail
