// SPDX-License-Identifier: MIT
// A planner accepts exactly the settings that it lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

#include "planner/setting_table.hpp"

namespace vantage {
namespace {

// The error message of make_planner for these settings; empty if there is none.
std::string objection(std::string_view planner, const PlannerSettings& settings) {
  const PlannerSetup setup{.sensor = RangeSensor::spherical(60, 30, 2.0 * std::numbers::pi, 1.0, 0.0, 4.0),
                           .platform = std::make_shared<FreeFlyer>()};
  try {
    (void)make_planner(planner, setup, settings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

bool is_number(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

TEST(PlannerSettings, EverySettingHasANameAndAMeaningAndItsDefaultIsTaken) {
  std::size_t settings = 0;
  for (const std::string_view planner : planner_names()) {
    std::set<std::string> names;
    PlannerSettings defaults;
    for (const PlannerSetting& setting : planner_settings(planner)) {
      SCOPED_TRACE(std::string(planner) + " " + setting.name);
      EXPECT_TRUE(names.insert(setting.name).second) << "twice";
      EXPECT_FALSE(setting.meaning.empty());
      EXPECT_EQ(setting.meaning.find('\n'), std::string::npos);
      EXPECT_TRUE(std::all_of(setting.name.begin(), setting.name.end(), [](unsigned char letter) {
        return std::islower(letter) != 0 || std::isdigit(letter) != 0 || letter == '_';
      }));
      if (!setting.default_value.empty()) {
        EXPECT_EQ(objection(planner, {{setting.name, setting.default_value}}), "");
        defaults[setting.name] = setting.default_value;
      }
      ++settings;
    }
    EXPECT_EQ(objection(planner, defaults), "");
    EXPECT_TRUE(names.contains("patience")) << planner;
  }
  EXPECT_GE(settings, 30U);
  EXPECT_THROW((void)planner_settings("best"), std::invalid_argument);
}

TEST(PlannerSettings, TextThatIsNoneIsRefusedByName) {
  std::size_t refused = 0;
  for (const std::string_view planner : planner_names()) {
    for (const PlannerSetting& setting : planner_settings(planner)) {
      for (const std::string text : {"", "x", "1x", " 1", "--1", "1e999", "nan"}) {
        const std::string message = objection(planner, {{setting.name, text}});
        EXPECT_NE(message, "") << planner << " " << setting.name << "=" << text;
        ++refused;
      }
    }
  }
  EXPECT_GE(refused, 7U * 30U);
}

// Every number has a range, and one of these values is outside it.
TEST(PlannerSettings, NumbersOutsideTheirRangeAreRefusedByName) {
  std::size_t numbers = 0;
  for (const std::string_view planner : planner_names()) {
    for (const PlannerSetting& setting : planner_settings(planner)) {
      if (!is_number(setting.default_value)) {
        continue;
      }
      const std::string message = objection(planner, {{setting.name, "-2"}});
      EXPECT_NE(message, "") << planner << " " << setting.name;
      ++numbers;
    }
  }
  EXPECT_GE(numbers, 20U);
}

struct Two {
  int whole = 3;
  double real = 0.5;
  bool flag = true;
};

detail::SettingTable<Two> table_of_two() {
  detail::SettingTable<Two> table("Two");
  table
      .number(
          "whole", "cells", "a whole number", detail::within(1, 9), [](Two & two) -> auto& { return two.whole; })
      .number(
          "real", "m", "a real number", detail::more_than(0), [](Two & two) -> auto& { return two.real; })
      .flag(
          "flag", "a choice", [](Two & two) -> auto& { return two.flag; });
  return table;
}

TEST(SettingTable, ListsWhatTheStructHolds) {
  const std::vector<PlannerSetting> list = table_of_two().list();
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].name, "whole");
  EXPECT_EQ(list[0].default_value, "3");
  EXPECT_EQ(list[0].unit, "cells");
  EXPECT_EQ(list[0].meaning, "a whole number");
  EXPECT_EQ(list[1].default_value, "0.5");
  EXPECT_EQ(list[2].default_value, "true");
}

TEST(SettingTable, ReadsAndRefuses) {
  const auto read = [](const PlannerSettings& settings) {
    Two two;
    table_of_two().read("twins", settings, two);
    return two;
  };
  const Two two = read({{"whole", "7"}, {"real", "2.25"}, {"flag", "false"}});
  EXPECT_EQ(two.whole, 7);
  EXPECT_EQ(two.real, 2.25);
  EXPECT_FALSE(two.flag);
  const auto message = [&](auto&& action) -> std::string {
    try {
      action();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([&] {
              (void)read({{"hole", "7"}});
            }),
            "planner 'twins' has no setting 'hole'; it has: whole, real, flag");
  EXPECT_EQ(message([&] {
              (void)read({{"whole", "7.5"}});
            }),
            "planner 'twins': setting 'whole' is '7.5', must be a whole number");
  EXPECT_EQ(message([&] {
              (void)read({{"flag", "yes"}});
            }),
            "planner 'twins': setting 'flag' is 'yes', must be one of true, false");
  const auto validate = [&](const Two& options) { return message([&] { table_of_two().validate(options); }); };
  EXPECT_EQ(validate({}), "");
  EXPECT_EQ(validate({.whole = 1}), "");
  EXPECT_EQ(validate({.whole = 9}), "");
  EXPECT_EQ(validate({.whole = 0}), "Two::whole is 0, must be in [1, 9]");
  EXPECT_EQ(validate({.whole = 10}), "Two::whole is 10, must be in [1, 9]");
  EXPECT_EQ(validate({.real = 0.0}), "Two::real is 0, must be > 0");
  EXPECT_EQ(validate({.real = std::numeric_limits<double>::quiet_NaN()}), "Two::real is nan, must be > 0");
}

}  // namespace
}  // namespace vantage
