// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vantage/evaluation/exploration_peers.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/plan_check.hpp>
#include <vantage/planner/tour_planner.hpp>
#include <vector>

#include "contract/asked_goals.hpp"
#include "contract/changing_world.hpp"
#include "contract/host.hpp"
#include "contract/scene.hpp"
#include "contract/slow_audit.hpp"
#include "contract/true_space.hpp"

namespace vantage::testing {

/// The pose `way_m` along a path.
[[nodiscard]] inline Pose along(const std::vector<Pose>& path, double way_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step_m = (path[i].translation() - path[i - 1].translation()).norm();
    if (way_m < step_m) {
      Pose pose = path[i];
      pose.translation() =
          path[i - 1].translation() + way_m / step_m * (path[i].translation() - path[i - 1].translation());
      return pose;
    }
    way_m -= step_m;
  }
  return path.back();
}

/// Whether two plans ask for the same.
[[nodiscard]] inline bool are_same(const Plan& a, const Plan& b) {
  return a.outcome == b.outcome && a.leftover == b.leftover && a.goal.pose.matrix() == b.goal.pose.matrix() &&
         a.goal.utility == b.goal.utility && a.sought == b.sought && a.path.size() == b.path.size() &&
         std::equal(a.path.begin(), a.path.end(), b.path.begin(),
                    [](const Pose& p, const Pose& q) { return p.matrix() == q.matrix(); });
}

/// A planner, or a peer of that name.
[[nodiscard]] inline std::unique_ptr<ExplorationPlanner> planner_named(const std::string& name,
                                                                       const PlannerSetup& setup) {
  const auto peers = exploration_peer_names();
  return std::find(peers.begin(), peers.end(), name) != peers.end() ? make_exploration_peer(name, setup)
                                                                    : make_planner(name, setup);
}

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
        map_({.resolution_m = scene.cell_m, .region = world_.frame.box_of(world_.solid.box())}),
        engine_(scene.seed) {
    if (scene.drives) {
      band_.emplace(map_.options(), band_above_floor(scene.cell_m, scene.floor));
    }
    make_planners();
    pose_ = pose_looking(start_of(host), 0.3);
    declare_free(start_clearance_m(known(), *platform_, scene_.planned_sensor()));
    for_each_cell(world_.solid.box(), [&](const VoxelIndex& cell) {
      if (world_.is_solid(cell)) {
        map_.set(cell, Occupancy::Unknown);  // the operator does not declare solid cells free
      }
    });
    look();
    explore();
  }

  DrivenRobot(const DrivenRobot&) = delete;  // the true space refers to members
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
  [[nodiscard]] const OccupancyMap& known() const { return band_ ? band_->plane() : map_; }
  [[nodiscard]] std::vector<VoxelIndex> left() const {
    return still_observable(known(), *platform_, scene_.planned_sensor(), pose_, looked_);
  }
  [[nodiscard]] double coverage() const { return space_->coverage(known(), *platform_, scene_.planned_sensor()); }
  /// Whether a person or a door is so near that the map may show no space for the body.
  [[nodiscard]] bool ends_beside_a_moving_object() const { return meets_a_moving_object(pose_, scene_.cell_m); }
  /// Removes the barrier, looks at where it was and goes on. A robot without its fence is another platform, so
  /// another planner recalls what was tried.
  void open() {
    const bool was_fence = scene_.barrier == Barrier::Fence;
    set_barrier(world_, std::exchange(scene_.barrier, Barrier::None), 0);
    space_ = std::make_unique<TrueSpace>(scene_, world_);
    if (was_fence) {
      const std::string memory = planner_->memory();
      make_planners();
      planner_->recall(known(), memory);
      on_threads_->recall(known(), memory);
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
  [[nodiscard]] PlannerSetup setup(int threads) const {
    PlannerSetup setup{.sensor = scene_.planned_sensor(), .platform = platform_, .seed = 7, .threads = threads};
    if (host_ == Host::PlansOnItsWay) {
      setup.motion = TourPlanner::default_motion();
    }
    return setup;
  }
  void make_planners() {
    platform_ = scene_.platform();
    planner_ = planner_named(name_, setup(1));
    on_threads_ = planner_named(name_, setup(2));
  }
  [[nodiscard]] Eigen::Vector3d start_of(Host host) const {
    const double cell = scene_.cell_m;
    const Eigen::Vector3d start = world_.frame.centre_of(world_.start);
    if (host == Host::OffCentre) {
      return start + cell * Eigen::Vector3d(0.31, -0.22, scene_.is_plane() ? 0.0 : 0.13);
    }
    const double corner = cell * (1.0 + scene_.body_cells + 1e-3);
    return host == Host::InACorner ? Eigen::Vector3d(corner, corner, scene_.is_plane() ? start.z() : corner) : start;
  }
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }

  // Declares the space around the robot free.
  void declare_free(double clearance_m) {
    if (band_) {
      declare_columns_free(clearance_m);
      return;
    }
    assume_free(map_, *platform_, pose_, clearance_m);
    if (scene_.rod_cells > 0.0) {
      map_.assume_free(platform_->body_box(pose_));
    }
  }
  // The same at all heights of the band, in columns that are free, and says that they have a floor.
  void declare_columns_free(double clearance_m) {
    OccupancyMap plane(known().options());
    assume_free(plane, *platform_, pose_, clearance_m);
    plane.assume_free(platform_->body_box(pose_));
    plane.for_each_known([&](const VoxelIndex& column, Occupancy /*state*/) {
      if (!space_->is_solid(column)) {
        Box box = world_.frame.box_of(column);
        box.min.head<2>().array() += 0.25 * scene_.cell_m;
        box.max.head<2>().array() -= 0.25 * scene_.cell_m;
        box.min.z() = band_->options().min_height_m + 0.25 * scene_.cell_m + 1e-9;
        box.max.z() = band_->options().max_height_m - 1e-9;
        map_.assume_free(box);
        band_->assume_floor(box);
      }
    });
    band_->follow(map_);
  }

  void look() {
    Scan scan = scan_of(world_, sensor_, truly_at());
    scan.world_from_sensor = pose_;
    map_.insert(scan);
    if (band_) {
      band_->follow(map_);
    }
    looked_.looks.push_back({pose_, known()});
    world_.tick(pose_.translation());
  }
  // The true pose when the robot believes that it is at `pose_`.
  Pose truly_at() {
    if (host_ != Host::Inexact) {
      return pose_;
    }
    const Eigen::Vector3d off(draw(-1, 1), draw(-1, 1), scene_.is_plane() ? 0.0 : draw(-1, 1));
    Pose pose = pose_;
    pose.linear() =
        Eigen::AngleAxisd(draw(-0.5, 0.5) * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()) * pose_.linear();
    pose.translation() += 0.01 * off.normalized();
    return pose;
  }

  Plan plan() {
    if (host_ != Host::PlansFromACopy) {
      const Plan made = planner_->plan(known(), pose_);
      if (host_ == Host::Perfect) {
        disagreements += are_same(made, on_threads_->plan(known(), pose_)) ? 0U : 1U;
      }
      return made;
    }
    const OccupancyMap copy = known();
    return planner_->plan(copy, pose_);
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
    const double whole_m = detail::length_m(last.path);
    double way_m = whole_m;
    Pose end = last.goal.pose;
    if (host_ == Host::Stuck) {
      return;
    }
    const bool aborts = (host_ == Host::AbortsSilently || host_ == Host::AbortsAndReports) && engine_() % 3 == 0;
    if (aborts) {
      way_m = 0.5 * whole_m;
      end = along(last.path, way_m);
    } else if (host_ == Host::PlansOnItsWay && whole_m > 3.0 * scene_.cell_m) {
      way_m = 3.0 * scene_.cell_m;
      end = along(last.path, way_m);
    } else if (host_ == Host::StopsShort) {
      way_m = std::max(0.0, whole_m - draw(0.0, 0.3));
      const double off_rad = draw(-15.0, 15.0) * std::numbers::pi / 180.0;
      end.translation() = along(last.path, way_m).translation();
      end.linear() = Eigen::AngleAxisd(off_rad, Eigen::Vector3d::UnitZ()) * end.linear();
    }
    pose_ = follow(way_m, end);
    if (host_ == Host::AbortsAndReports) {
      planner_->report(known(), pose_, aborts ? GoalResult::Failed : GoalResult::Reached);
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
    // A host that is off by half a degree maps distant surfaces beside their true place.
    const double off_m = host_ == Host::Inexact ? 0.01 + 0.01 * sensor_.max_range_m : 1e-6;
    return space_->touched(pose, -off_m, [&](const VoxelIndex& cell) { return space_->is_solid(cell); });
  }
  // Moves the robot to a random place where it fits.
  void carry() {
    for (int attempt = 0; attempt < 200; ++attempt) {
      Pose there = pose_;
      const VoxelIndex extent = world_.solid.box().extent();
      there.translation() = world_.frame.centre_of(
          {static_cast<std::int32_t>(draw(1.0, extent.x - 1.0)), static_cast<std::int32_t>(draw(1.0, extent.y - 1.0)),
           scene_.is_plane() ? world_.start.z : static_cast<std::int32_t>(draw(2.0, 5.0))});
      if (static_cells_in(there).empty() && !world_.is_solid(world_.frame.cell_of(there.translation()))) {
        pose_ = there;
        declare_free(0.0);
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
  OccupancyMap map_;
  std::optional<HeightBand> band_;
  std::mt19937 engine_;
  std::unique_ptr<ExplorationPlanner> planner_;
  std::unique_ptr<ExplorationPlanner> on_threads_;
  Pose pose_ = Pose::Identity();
  LookedAt looked_;
  std::optional<double> opened_after_m_;  // of the way gone
};

}  // namespace vantage::testing
