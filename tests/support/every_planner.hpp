// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vector>

namespace vantage::test {

/// The names of all planners, as values of a parameterised test.
inline std::vector<std::string> every_planner() { return {planner_names().begin(), planner_names().end()}; }

/// The name of a planner as GoogleTest wants names of tests.
inline std::string test_name(std::string planner) {
  std::replace(planner.begin(), planner.end(), '-', '_');
  return planner;
}

/// Names a test that has a planner as its parameter.
inline std::string name_of_planner(const ::testing::TestParamInfo<std::string>& planner) {
  return test_name(planner.param);
}

}  // namespace vantage::test
