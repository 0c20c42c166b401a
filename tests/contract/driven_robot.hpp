// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/plan_check.hpp>
#include <vantage/planner/tour_planner.hpp>
#include <vector>

#include "contract/asked_goals.hpp"
#include "contract/changing_world.hpp"
#include "contract/host.hpp"
#include "contract/host_errors.hpp"
#include "contract/robot_map.hpp"
#include "contract/scene.hpp"
#include "contract/slow_audit.hpp"
#include "contract/true_space.hpp"
#include "contract/twin_planners.hpp"

namespace vantage::testing {

/// A robot, its host and the results of the run.
class DrivenRobot {
 public:
  static constexpr std::size_t kMostPlans = 1000;

  DrivenRobot(const std::string& planner, Host host, const Scene& scene)
      : name_(planner),
        host_(host),
        scene_(scene),
        world_(scene.world()),
        space_(std::make_unique<TrueSpace>(scene_, world_)),
        sensor_(scene.sensor()),
        map_(scene_, world_),
        errors_(host, scene_) {
    make_planners();
    pose_ = pose_looking(errors_.start(world_), 0.3);
    map_.declare_free(*platform_, pose_, start_clearance_m(known(), *platform_, scene_.sensor()), *space_);
    map_.declare_floor(*platform_, pose_, scene_.sensor(), *space_);
    map_.forget_solid_cells();
    look();
    explore();
  }

  DrivenRobot(const DrivenRobot&) = delete;  // the true space, the map and the errors refer to members
  DrivenRobot& operator=(const DrivenRobot&) = delete;

  std::size_t plans = 0;
  double gone_m = 0.0;
  Plan last;
  std::size_t collisions = 0;      // poses in which the body overlaps a solid cell that the map does not hold free
  std::set<VoxelIndex> misled_by;  // solid cells that it overlaps and that the map holds free
  std::set<VoxelIndex> pits_met;   // columns without a floor that it overlaps, whatever the map says
  AskedGoals asked;
  std::size_t disagreements = 0;  // between plans of one and of two threads
  std::size_t refused_ways = 0;   // paths with a motion that the platform does not admit

  [[nodiscard]] const ChangingWorld& world() const { return world_; }
  /// The map that the planner plans in.
  [[nodiscard]] const OccupancyMap& known() const { return map_.known(); }
  [[nodiscard]] std::vector<VoxelIndex> left() const {
    return still_observable(known(), *platform_, scene_.sensor(), pose_, looked_);
  }
  [[nodiscard]] double coverage() const { return space_->coverage(known(), *platform_, scene_.sensor()); }
  /// Whether a person or a door is so near that the map may show no space for the body.
  [[nodiscard]] bool ends_beside_a_moving_object() const { return meets_a_moving_object(pose_, scene_.cell_m); }
  /// Removes the barrier, looks at where it was and goes on. A robot without its fence is another platform, so
  /// another planner recalls what was tried.
  void open() {
    const bool was_fence = scene_.barrier == Barrier::Fence;
    set_barrier(world_, std::exchange(scene_.barrier, Barrier::None), 0);
    space_ = std::make_unique<TrueSpace>(scene_, world_);
    if (was_fence) {
      const std::string memory = planners_->memory();
      make_planners();
      planners_->recall(known(), memory);
    }
    opened_after_m_ = gone_m;
    Eigen::Vector3d before = world_.frame.centre_of(world_.doorway.lo + VoxelIndex{-3, 1, 0});
    before.z() = pose_.translation().z();
    pose_ = pose_looking(before, 0.0);
    look();
    explore();
  }

 private:
  // A robot that plans on its way has a motion model.
  void make_planners() {
    platform_ = scene_.platform();
    PlannerSetup setup{.sensor = scene_.sensor(), .platform = platform_, .seed = 7};
    if (host_ == Host::PlansOnItsWay) {
      setup.motion = TourPlanner::default_motion();
    }
    planners_.emplace(name_, setup);
  }

  void look() {
    Scan scan = scan_of(world_, sensor_, errors_.truly_at(pose_));
    scan.world_from_sensor = pose_;
    map_.insert(scan);
    looked_.looks.push_back({pose_, known()});
    world_.tick(pose_.translation());
  }

  Plan plan() {
    if (host_ == Host::PlansFromACopy) {
      const OccupancyMap copy = known();
      return planners_->plan(copy, pose_);
    }
    const Plan made = planners_->plan(known(), pose_);
    if (host_ == Host::Perfect) {
      disagreements += planners_->agree_on(made, known(), pose_) ? 0U : 1U;
    }
    return made;
  }

  void explore() {
    std::size_t waits = 0;
    for (; plans < kMostPlans; ++plans) {
      last = plan();
      const bool is_over = last.outcome == Outcome::Explored && gone_m != opened_after_m_;
      const bool may_wait = (opened_after_m_ || !world_.is_static()) && waits < 30;
      if (last.outcome != Outcome::Move && !is_over && may_wait) {
        ++waits;  // as the contract asks: plan again later
        asked.begin_again();
        look();
        continue;
      }
      if (last.outcome != Outcome::Move) {
        return;
      }
      asked.count(last, pose_, known());
      for (std::size_t i = 1; i < last.path.size(); ++i) {
        refused_ways += platform_->admits_motion(known(), last.path[i - 1], last.path[i]) ? 0U : 1U;
      }
      for (const VoxelIndex& cell : last.sought) {
        looked_.sought[cell].insert(known().frame().cell_of(last.goal.pose.translation()));
      }
      go();
      look();
    }
  }

  void go() {
    if (host_ == Host::Stuck) {
      return;
    }
    const Stop stop = errors_.stop_of(last);
    pose_ = follow(stop.way_m, stop.pose);
    if (host_ == Host::AbortsAndReports) {
      planners_->report(known(), pose_, stop.aborts ? GoalResult::Failed : GoalResult::Reached);
    }
    if (host_ == Host::MovedByHand && plans % 5 == 4) {
      carry();
    }
  }
  // Moves along the path, at most to a person. Returns where the robot stops.
  Pose follow(double way_m, Pose end) {
    const std::vector<VoxelIndex> leaves = static_cells_in(pose_);
    if (host_ == Host::Outstretched) {
      for (std::size_t i = 1; i < last.path.size(); ++i) {
        for_each_turn(last.path[i - 1], last.path[i], [&](const Pose& pose) { count_collision(pose, leaves); });
      }
    }
    for (double at_m = 0.0; at_m < way_m; at_m += 0.5 * scene_.cell_m) {
      if (meets_a_moving_object(along(last.path, at_m + 0.5 * scene_.cell_m))) {  // the controller stops
        way_m = at_m;
        end = along(last.path, at_m);
      }
      count_collision(along(last.path, at_m), leaves);
      if (scene_.drives && at_m > 0.0 && at_m < way_m && is_closed_from(along(last.path, at_m))) {
        way_m = at_m;
        end = along(last.path, at_m);
      }
    }
    count_collision(end, leaves);
    gone_m += way_m;
    return end;
  }
  // Scans on the way. Whether the rest of the path is closed then.
  [[nodiscard]] bool is_closed_from(const Pose& pose) {
    pose_ = pose;
    look();
    return check(last, known(), *platform_, pose_) == PlanCheck::WayClosed;
  }
  // Whether a person or a closing door is within `gap_m` of the body.
  [[nodiscard]] bool meets_a_moving_object(const Pose& pose, double gap_m = 0.0) const {
    return !space_
                ->touched(pose, gap_m,
                          [&](const VoxelIndex& cell) {
                            return world_.solid.value_or(cell, 1) == 0 && world_.is_solid(cell);
                          })
                .empty();
  }
  // A ray through the edge of a solid cell may clear it in the map; then the map is wrong, not the plan. If a later
  // scan corrects the map, the body has to leave these cells, which were counted when it came.
  void count_collision(const Pose& pose, const std::vector<VoxelIndex>& leaves) {
    bool collides = false;
    for (const VoxelIndex& cell : static_cells_in(pose)) {
      if (scene_.pits && is_pit(world_, cell)) {
        pits_met.insert(cell);
      }
      if (std::find(leaves.begin(), leaves.end(), cell) != leaves.end()) {
        continue;
      }
      if (known().at(cell) == Occupancy::Free) {
        misled_by.insert(cell);
      } else {
        collides = true;
      }
    }
    collisions += collides ? 1U : 0U;
  }
  // The static solid cells that the body overlaps.
  [[nodiscard]] std::vector<VoxelIndex> static_cells_in(const Pose& pose) const {
    return space_->touched(pose, -errors_.surface_m(sensor_),
                           [&](const VoxelIndex& cell) { return space_->is_solid(cell); });
  }
  // Moves the robot to a random place where it fits.
  void carry() {
    for (int attempt = 0; attempt < 200; ++attempt) {
      Pose there = pose_;
      there.translation() = world_.frame.centre_of(errors_.anywhere(world_));
      if (static_cells_in(there).empty() && !world_.is_solid(world_.frame.cell_of(there.translation()))) {
        pose_ = there;
        map_.declare_free(*platform_, pose_, 0.0, *space_);
        map_.declare_floor(*platform_, pose_, scene_.sensor(), *space_);
        return;
      }
    }
  }

  std::string name_;
  Host host_;
  Scene scene_;
  ChangingWorld world_;
  std::unique_ptr<TrueSpace> space_;
  RangeSensor sensor_;
  std::shared_ptr<const Platform> platform_;
  RobotMap map_;
  HostErrors errors_;
  std::optional<TwinPlanners> planners_;
  Pose pose_ = Pose::Identity();
  LookedAt looked_;
  std::optional<double> opened_after_m_;  // of the way gone
};

}  // namespace vantage::testing
