// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vantage/planner/exploration_planner.hpp>
#include <vector>

namespace vantage::apps {

// The places that a planner asked to look from, where each time the recorded view nearest to its goal was chosen: how
// far they are from the view before and from the one chosen says what such a choice can be worth.
class NamedGoals {
 public:
  void add(const Plan& plan, const Pose& last, const Pose& chosen);

  // One sentence.
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
  std::vector<Gap> from_last_;  // one for every plan that named a place
  std::vector<Gap> from_chosen_;
};

}  // namespace vantage::apps
