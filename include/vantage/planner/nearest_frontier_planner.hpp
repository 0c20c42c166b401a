// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/failed_views.hpp>
#include <vantage/planner/frontier_surveyor.hpp>
#include <vantage/planner/make_planner.hpp>

namespace VANTAGE_EXPORT vantage {

/// Goes for the frontier with the shortest way to a place that sees it (after Yamauchi 1997): the plainest baseline.
/// There it turns so that most other frontier cells come into view beside the one it came for.
class NearestFrontierPlanner final : public ExplorationPlanner {
 public:
  /// Throws std::invalid_argument naming the option at fault.
  explicit NearestFrontierPlanner(const PlannerSetup& setup, const FrontierSurveyOptions& options = {});

  /// "nearest-frontier".
  [[nodiscard]] std::string_view name() const override { return "nearest-frontier"; }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) override;

 private:
  PlannerSetup setup_;
  FrontierSurveyOptions options_;
  FailedViews failed_;
  FrontierSurveyor surveyor_;
};

}  // namespace vantage
