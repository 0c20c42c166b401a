// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vantage/arm/arm.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/tried_views.hpp>
#include <vantage/view/unknown_sight.hpp>
#include <vector>

namespace vantage::apps {

/// The peer of frontier-void with an arm: for every view it weighs thousands of the poses that the arm can take
/// (`exhaustive_poses`), wherever they are and look, by the same utility, and takes the best to which there is a way.
/// It knows neither frontiers nor clusters, and is slow.
class ExhaustivePlanner final : public ExplorationPlanner {
 public:
  /// What the command line calls it.
  static constexpr std::string_view kName = "exhaustive";

  /// Views from which less of the voids is expected than `least_view_m3` are none. Throws std::invalid_argument as
  /// make_planner.
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
