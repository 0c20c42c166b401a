// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vantage/planner/exploration_planner.hpp>
#include <vector>

namespace vantage::apps {

// Collects how far the goals of a planner are from the previous view and from the recorded view chosen instead
// (the one nearest to the goal). It shows how meaningful such a choice is.
class NamedGoals {
 public:
  void add(const Plan& plan, const Pose& last, const Pose& chosen);

  // Prints one sentence.
  void print(std::ostream& out, const std::string& planner) const;
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  struct Gap {
    double m = 0.0;
    double deg = 0.0;
  };
  static Gap between(const Pose& a, const Pose& b);
  static Gap median_of(std::vector<Gap> gaps);

  std::size_t plans_ = 0;
  std::vector<Gap> from_last_;  // one per plan with a goal
  std::vector<Gap> from_chosen_;
};

}  // namespace vantage::apps
