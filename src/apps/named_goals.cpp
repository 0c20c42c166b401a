// SPDX-License-Identifier: MIT
#include "apps/named_goals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

namespace vantage::apps {

NamedGoals::Gap NamedGoals::between(const Pose& a, const Pose& b) {
  const double angle = Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
  return {(a.translation() - b.translation()).norm(), std::abs(angle) * 180.0 / std::numbers::pi};
}

// Medians of the metres and of the degrees, separately.
NamedGoals::Gap NamedGoals::median_of(std::vector<Gap> gaps) {
  const auto median = [&](double Gap::*part) {
    const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::nth_element(gaps.begin(), middle, gaps.end(), [&](const Gap& a, const Gap& b) { return a.*part < b.*part; });
    return (*middle).*part;
  };
  return {median(&Gap::m), median(&Gap::deg)};
}

void NamedGoals::add(const Plan& plan, const Pose& last, const Pose& chosen) {
  ++plans_;
  if (plan.outcome == Outcome::Move) {
    from_last_.push_back(between(plan.goal.pose, last));
    from_chosen_.push_back(between(plan.goal.pose, chosen));
  }
}

void NamedGoals::print(std::ostream& out, const std::string& planner) const {
  char text[256];
  std::snprintf(text, sizeof text, "%s named a place to look from in %zu of %zu plans", planner.c_str(),
                from_last_.size(), plans_);
  out << text;
  if (!from_last_.empty()) {
    const Gap last = median_of(from_last_);
    const Gap chosen = median_of(from_chosen_);
    std::snprintf(text, sizeof text, ", in the median %.2f m and %.0f deg off the view before,", last.m, last.deg);
    out << text;
    std::snprintf(text, sizeof text, " %.2f m and %.0f deg off the nearest one left", chosen.m, chosen.deg);
    out << text;
  }
  out << (from_last_.size() == plans_ ? ".\n" : "; without one, the view furthest from all taken was chosen.\n");
}

nlohmann::ordered_json NamedGoals::json() const {
  const auto gaps = [](const std::vector<Gap>& all) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Gap& gap : all) {
      json.push_back({{"m", gap.m}, {"deg", gap.deg}});
    }
    return json;
  };
  return {{"plans", plans_}, {"from_last", gaps(from_last_)}, {"from_chosen", gaps(from_chosen_)}};
}

}  // namespace vantage::apps
