// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>

namespace VANTAGE_EXPORT vantage {

/// Goes to the nearest place from which some frontier is seen (Yamauchi 1997, "A Frontier-Based Approach for
/// Autonomous Exploration"), and looks at as much of the frontier from there as comes into view.
class NearestFrontierPlanner final : public FrontierPlanner {
 public:
  using FrontierPlanner::FrontierPlanner;

  /// "nearest-frontier".
  [[nodiscard]] std::string_view name() const override { return "nearest-frontier"; }

 private:
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;
};

}  // namespace vantage
