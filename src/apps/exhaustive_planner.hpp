// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vantage/arm/arm.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/view/tried_views.hpp>
#include <vantage/view/unknown_sight.hpp>
#include <vector>

namespace vantage::apps {

/// The peer of frontier-void with an arm. For every view it scores thousands of the poses that the arm can take
/// (`exhaustive_poses`) by the same utility and takes the best one that has a path. It knows neither frontiers nor
/// clusters, and it is slow.
class ExhaustivePlanner final : public ExplorationPlanner {
 public:
  /// Its name on the command line.
  static constexpr std::string_view kName = "exhaustive";

  /// Views that are expected to show less than `least_view_m3` cubic metres of voids do not count. Throws
  /// std::invalid_argument as make_planner.
  ExhaustivePlanner(std::shared_ptr<const Arm> arm, const PlannerSetup& setup, double least_view_m3);

  [[nodiscard]] std::string_view name() const override { return kName; }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) override;

 private:
  struct Weighed {
    Pose pose;
    double void_cells = 0.0;
    std::vector<VoxelIndex> hoped = {};
  };
  void weigh(std::vector<Weighed>& views, const OccupancyMap& map, const UnknownSight& sight, const RayCaster& caster,
             const ViewRays& rays) const;

  std::shared_ptr<const Arm> arm_;
  PlannerSetup setup_;
  double least_view_m3_;
  TriedViews tried_;
};

}  // namespace vantage::apps
