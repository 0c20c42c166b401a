// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>

namespace VANTAGE_EXPORT vantage {

/// Goes along the shortest path to the nearest place that sees a frontier, and takes the orientation there that sees
/// most of the frontier. (Yamauchi 1997, "A Frontier-Based Approach for Autonomous Exploration".)
class NearestFrontierPlanner final : public FrontierPlanner {
 public:
  using FrontierPlanner::FrontierPlanner;

  [[nodiscard]] std::string_view name() const override { return "nearest-frontier"; }

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override { return nearest_view(situation); }
};

}  // namespace vantage
