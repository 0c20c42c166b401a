// SPDX-License-Identifier: MIT
#include <vantage/settings/impl/setting_table.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace vantage {
namespace {

struct Three {
  double first = 1.0;
  double second = 0.5;
};

struct Two {
  int whole = 3;
  double real = 0.5;
  bool flag = true;
  Three three = {};
};

detail::SettingTable<Two> table_of_two() {
  detail::SettingTable<Two> table("Two");
  table.number("whole", "cells", "a whole number", detail::within(1, 9), &Two::whole)
      .number("real", "m", "a real number", detail::more_than(0), &Two::real)
      .flag("flag", "a choice", &Two::flag)
      .mode<Three>("mode", "replaces three", {{"all", {}}, {"none", {.first = 0.0}}}, &Two::three)
      .number("first", "", "in another struct", detail::at_least(0), &Two::three, &Three::first)
      .limit("Three::second", detail::within(0, 1), &Two::three, &Three::second);
  return table;
}

TEST(SettingTable, ListsWhatTheStructHolds) {
  const std::vector<Setting> list = table_of_two().list();
  ASSERT_EQ(list.size(), 5U);
  EXPECT_EQ(list[0].name, "whole");
  EXPECT_EQ(list[0].default_value, "3");
  EXPECT_EQ(list[0].unit, "cells");
  EXPECT_EQ(list[0].meaning, "a whole number");
  EXPECT_EQ(list[1].default_value, "0.5");
  EXPECT_EQ(list[2].default_value, "true");
  EXPECT_EQ(list[3].default_value, "");
  EXPECT_EQ(list[4].default_value, "1");
}

TEST(SettingTable, ReadsAndRefuses) {
  const auto read = [](const Settings& settings) {
    Two two;
    table_of_two().read("twins", settings, two);
    return two;
  };
  const Two two = read({{"whole", "7"}, {"real", "2.25"}, {"flag", "false"}});
  EXPECT_EQ(two.whole, 7);
  EXPECT_EQ(two.real, 2.25);
  EXPECT_FALSE(two.flag);
  EXPECT_EQ(read({{"mode", "none"}}).three.first, 0.0);
  EXPECT_EQ(read({{"mode", "none"}, {"first", "2"}}).three.first, 2.0);
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
            "planner 'twins' has no setting 'hole'; it has: whole, real, flag, mode, first");
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
  EXPECT_EQ(validate({.three = {.second = 2.0}}), "Three::second is 2, must be in [0, 1]");
  EXPECT_EQ(validate({.real = 0.0}), "Two::real is 0, must be > 0");
  EXPECT_EQ(validate({.real = std::numeric_limits<double>::quiet_NaN()}), "Two::real is nan, must be > 0");
}

}  // namespace
}  // namespace vantage
