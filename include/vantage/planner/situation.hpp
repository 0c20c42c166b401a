// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontier_tracker.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/frontier_survey.hpp>
#include <vantage/planner/frontier_surveyor.hpp>
#include <vantage/planner/planner_setup.hpp>
#include <vantage/planner/target_view.hpp>
#include <vantage/planner/tried_views.hpp>
#include <vantage/raytrace/following_caster.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a plan is made from: the map and its frontier, where the platform can go, which frontier cells can be seen
/// from where, and which views were tried before. Owned by a planner, brought up to date once per plan; a strategy
/// reads it and chooses.
///
///     situation.sync(map, current);
///     if (std::optional<Plan> end = situation.end()) return *end;
///     const FrontierTarget& target = situation.survey().targets.front();
class Situation {
 public:
  /// Throws std::invalid_argument naming the part of the setup or the option at fault.
  explicit Situation(const PlannerSetup& setup, const FrontierSurveyOptions& options = {});

  /// Takes the map and the sensor's pose as they are now; both must outlive the plan. Throws std::invalid_argument
  /// unless `current` is finite and rigid up to 1e-3.
  void sync(const OccupancyMap& map, const Pose& current);
  /// The plan that ends the run or turns the sensor where it stands, if there is nothing to choose from: no target is
  /// left. Its leftover and its counts are those of the survey.
  [[nodiscard]] std::optional<Plan> end();
  /// Leaves out, for this plan, the targets of a view to which there is no way, and those seen from its place.
  /// Returns whether there were any.
  bool drop(const TargetView& view);
  /// Remembers that this plan was made.
  void remember(const Plan& plan, std::vector<VoxelIndex> hoped);

  /// What every planner needs to know of the robot.
  [[nodiscard]] const PlannerSetup& setup() const { return setup_; }
  /// What carries the sensor.
  [[nodiscard]] const Platform& platform() const { return *setup_.platform; }
  /// What it sees.
  [[nodiscard]] const RangeSensor& sensor() const { return setup_.sensor; }
  /// The map of the last `sync`.
  [[nodiscard]] const OccupancyMap& map() const { return *map_; }
  /// The sensor's pose at the last `sync`, its rotation orthonormal.
  [[nodiscard]] const Pose& current() const { return current_; }
  /// Reachable space, observable frontier cells and where to see them from.
  [[nodiscard]] const FrontierSurvey& survey() const { return survey_; }
  /// The cells the platform can bring the sensor to.
  [[nodiscard]] const ReachableSpace& reachable() const { return survey_.reachable; }
  /// Frontier cells and their clusters, kept by the map's change log.
  [[nodiscard]] const FrontierTracker& frontier() const { return *frontier_; }
  /// What was tried and what came of it.
  [[nodiscard]] const TriedViews& tried() const { return tried_; }
  /// How following the last plan ended.
  void report(GoalResult result) { tried_.report(result); }
  /// Rays in the map of the last `sync`, and those of the sensor, as dense as the map's cells ask for. Following the
  /// map costs something: only strategies that cast rays ask. The first call after a `sync` follows the map, later
  /// ones may come from several threads.
  [[nodiscard]] const RayCaster& caster() const;
  /// The rays of the sensor.
  [[nodiscard]] const ViewRays& rays() const;
  /// The plan with the counts of the survey filled in, and nothing chosen.
  [[nodiscard]] Plan open_plan() const;

 private:
  void follow_rays() const;
  void note_what_was_in_vain();
  [[nodiscard]] bool hardly_moves() const;
  [[nodiscard]] std::optional<Plan> turn_on_the_spot() const;
  [[nodiscard]] std::optional<VoxelIndex> place_cut_off() const;

  PlannerSetup setup_;
  FrontierSurveyOptions options_;
  const OccupancyMap* map_ = nullptr;
  Pose current_ = Pose::Identity();
  KnownMap followed_;
  std::optional<FrontierTracker> frontier_;
  TriedViews tried_;
  FrontierSurveyor surveyor_;
  FrontierSurvey survey_;
  mutable FollowingCaster looking_;
  mutable bool looking_follows_ = false;  // the map of the last sync
  double sync_ms_ = 0.0;
};

}  // namespace vantage
