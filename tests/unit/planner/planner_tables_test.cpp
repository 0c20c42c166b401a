// SPDX-License-Identifier: MIT
// A planner accepts exactly the settings that it lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

namespace vantage {
namespace {

// The error message of make_planner for these settings; empty if there is none.
std::string objection(std::string_view planner, const Settings& settings) {
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
    Settings defaults;
    for (const Setting& setting : planner_settings(planner)) {
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

// The parts of a text between separators, without blanks and back quotes around them.
std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text + separator);
  for (std::string part; std::getline(in, part, separator);) {
    const std::size_t first = part.find_first_not_of(" `");
    const std::size_t last = part.find_last_not_of(" `");
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last + 1 - first));
  }
  return parts;
}

// The defaults by setting that docs/planners.md gives below the heading of a planner.
std::map<std::string, std::string> documented_settings(const std::string& planner) {
  std::map<std::string, std::string> settings;
  std::ifstream page(VANTAGE_SOURCE_DIR "/docs/planners.md");
  std::string heading;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) {
      heading = line;
    } else if (heading == "### " + planner && line.starts_with("| `")) {
      const std::vector<std::string> columns = parts_of(line, '|');
      const std::vector<std::string> names = parts_of(columns[1], ',');
      const std::vector<std::string> defaults = parts_of(columns[2], ',');
      EXPECT_EQ(names.size(), defaults.size()) << line;
      for (std::size_t i = 0; i < std::min(names.size(), defaults.size()); ++i) {
        settings[names[i]] = defaults[i];
      }
    }
  }
  return settings;
}

TEST(PlannerSettings, ThePageOfPlannersHasAllOfThemWithTheirDefaults) {
  for (const std::string_view planner : planner_names()) {
    const std::map<std::string, std::string> documented = documented_settings(std::string(planner));
    std::size_t settings = 0;
    for (const Setting& setting : planner_settings(planner)) {
      if (setting.name == "patience") {  // common to all
        continue;
      }
      ++settings;
      const auto found = documented.find(setting.name);
      ASSERT_NE(found, documented.end()) << planner << " " << setting.name;
      const bool is_same = is_number(setting.default_value) && is_number(found->second)
                               ? std::stod(setting.default_value) == std::stod(found->second)
                               : setting.name == "mode" || setting.default_value == found->second;
      EXPECT_TRUE(is_same) << planner << " " << setting.name << ": " << found->second;
    }
    EXPECT_EQ(documented.size(), settings) << planner;
  }
}

TEST(PlannerSettings, TextThatIsNoneIsRefusedByName) {
  std::size_t refused = 0;
  for (const std::string_view planner : planner_names()) {
    for (const Setting& setting : planner_settings(planner)) {
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
    for (const Setting& setting : planner_settings(planner)) {
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

}  // namespace
}  // namespace vantage
