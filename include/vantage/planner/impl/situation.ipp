// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vantage/planner/situation.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vantage/view/target_view.hpp>

#include <vantage/planner/impl/blocked_reasons.hpp>
#include <vantage/planner/impl/stopwatch.hpp>
#include <vantage/robot/impl/block_ways.hpp>
#include <vantage/view/impl/clear_line.hpp>
#include <vantage/view/impl/frontier_survey_settings.hpp>

namespace vantage {
namespace detail {

inline const PlannerSetup& valid(const PlannerSetup& setup, const FrontierSurveyOptions& options) {
  setup.validate();
  detail::frontier_survey_settings().validate(options);
  return setup;
}

// A goal further away is far: the search for the shortest route would visit most of a large space.
inline constexpr double kFarCells = 300.0;
inline constexpr std::size_t kBlocksAtOnce = 8;

// Most places that a plan puts to rest because no way leads to a view from them: a plan must end.
inline constexpr std::size_t kMostPlacesWithoutWay = 256;

// Blocks of about a metre.
inline std::int32_t side_for(double cell_m) { return cell_m < 0.15 ? 8 : 4; }

}  // namespace detail

VANTAGE_INLINE Situation::Situation(const PlannerSetup& setup, const FrontierSurveyOptions& options)
    : setup_(detail::valid(setup, options)),
      options_(options),
      tried_(setup.sensor, {setup.goal_tolerance_m, setup.goal_tolerance_rad, options.patience}),
      surveyor_(setup.platform, setup.sensor, options) {}

VANTAGE_INLINE void Situation::sync(const OccupancyMap& map, const Pose& current) {
  detail::Stopwatch watch;
  current_ = orthonormalised(current);
  frontier_.follow(map);
  frontier_cells_ = frontier_->cells();
  map_ = &map;
  looking_follows_ = false;
  without_way_.clear();
  places_left_ = detail::kMostPlacesWithoutWay;
  if (tried_.review(map, current_)) {
    note_what_was_in_vain();
  }
  find_targets();
  sync_ms_ = watch.lap_ms();
}

VANTAGE_INLINE void Situation::find_targets() {
  ways_follow_ = false;
  survey_ = surveyor_.survey(*map_, current_, tried_, frontier_cells_);
  if (survey_.targets.empty() && tried_.try_resting_again()) {
    survey_ = surveyor_.survey(*map_, current_, tried_, frontier_cells_);
  }
  set_aside_.clear();
  set_refused_aside();
  is_stuck_ = survey_.targets.empty() && tried_.is_stuck(current_);
  if (survey_.targets.empty()) {
    survey_.targets.swap(set_aside_);
  }
}

// One side of the world may be refused, and the robot may be able to go elsewhere: far from refused directions, if
// there are targets, or at least beside them unless it seems not to move at all.
VANTAGE_INLINE void Situation::set_refused_aside() {
  const std::vector<Eigen::Vector3d> refused = tried_.refused_directions(current_);
  if (refused.empty()) {
    return;
  }
  double angle_rad = detail::kRefusedRad;
  const auto leads_elsewhere = [&](const FrontierTarget& target) {
    const Eigen::Vector3d place = map_->frame().centre_of(target.viewpoint);
    return detail::leads_elsewhere(refused, current_.translation(), place, angle_rad);
  };
  if (!tried_.is_stuck(current_) && std::none_of(survey_.targets.begin(), survey_.targets.end(), leads_elsewhere)) {
    angle_rad = 0.5 * detail::kRefusedRad;
  }
  const auto aside = std::stable_partition(survey_.targets.begin(), survey_.targets.end(), leads_elsewhere);
  set_aside_.insert(set_aside_.end(), aside, survey_.targets.end());
  survey_.targets.erase(aside, survey_.targets.end());
}

// Stores as looked at in vain the unknown neighbours of frontier cells that are in the field of view, near enough
// (half the resolving range) and in clear line of sight, edges included, since this scan should have resolved them.
VANTAGE_INLINE void Situation::note_what_was_in_vain() {
  const VoxelIndex here = map_->frame().cell_of(current_.translation());
  const double furthest_m = std::min(sensor().max_range_m, 0.5 * sensor().resolving_range_m(map_->resolution_m()));
  std::uint64_t operations = 0;
  for (const VoxelIndex& cell : frontier_cells_) {
    if ((map_->frame().centre_of(cell) - current_.translation()).norm() > furthest_m) {
      continue;
    }
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex unknown = cell + step;
      if (map_->in_region(unknown) && map_->at(unknown) == Occupancy::Unknown &&
          (map_->frame().centre_of(unknown) - current_.translation()).norm() <= furthest_m &&
          sees(*map_, sensor(), current_, unknown, operations) &&
          detail::is_clear_line(*map_, current_.translation(), unknown)) {
        tried_.in_vain(*map_, unknown, here);
      }
    }
  }
}

VANTAGE_INLINE Plan Situation::open_plan() const {
  Plan plan;
  plan.leftover = survey_.leftover;
  plan.statistics.frontier_cells = survey_.frontier_cells;
  plan.statistics.observable_cells = survey_.targets.size();
  plan.statistics.reachable_cells = reachable().size();
  plan.statistics.ray_operations = survey_.ray_operations;
  plan.statistics.survey_ms = sync_ms_;
  return plan;
}

VANTAGE_INLINE bool Situation::drop(const TargetView& view) {
  const VoxelIndex place = map_->frame().cell_of(view.view.pose.translation());
  without_way_.push_back(place);
  const bool any = std::erase_if(survey_.targets, [&](const FrontierTarget& target) {
                     return target.viewpoint == place ||
                            std::find(view.unknown.begin(), view.unknown.end(), target.unknown) != view.unknown.end();
                   }) > 0;
  if (survey_.targets.empty()) {
    survey_.targets = std::exchange(set_aside_, {});
  }
  return any;
}

VANTAGE_INLINE bool Situation::look_elsewhere() {
  detail::Stopwatch watch;
  bool any = false;
  for (const VoxelIndex& place : std::exchange(without_way_, {})) {
    if (places_left_ > 0 && !tried_.rests(place)) {
      --places_left_;
      tried_.no_way_to(place);
      any = true;
    }
  }
  if (any) {
    find_targets();
  }
  sync_ms_ += watch.lap_ms();
  return any;
}

VANTAGE_INLINE bool Situation::remember(const Plan& plan, std::vector<VoxelIndex> hoped) {
  if (tried_.expect(*map_, plan.path, plan.sought, std::move(hoped))) {
    return true;
  }
  std::erase_if(survey_.targets, [&](const FrontierTarget& target) { return tried_.rests(target.viewpoint); });
  set_refused_aside();
  if (survey_.targets.empty()) {
    find_targets();
  }
  return false;
}

VANTAGE_INLINE std::optional<Pose> Situation::goal_ahead() const {
  const std::optional<Pose> goal = tried_.goal_ahead();
  const bool can_be_reached =
      goal && reachable().contains(map_->frame().cell_of(goal->translation())) && platform().admits(*map_, *goal);
  return can_be_reached ? goal : std::nullopt;
}

VANTAGE_INLINE const detail::BlockWays& Situation::ways() const {
  const VoxelFrame& frame = map_->frame();
  if (!ways_ || ways_->frame().size_m != frame.size_m) {
    ways_ = std::make_shared<detail::BlockWays>(frame, detail::side_for(frame.size_m));
  }
  if (!std::exchange(ways_follow_, true)) {
    ways_->follow([&space = reachable()](const VoxelIndex& brick) {
      const BrickPlane* const cells = space.find(brick);
      return cells == nullptr ? BrickPlane{} : *cells;
    });
  }
  return *ways_;
}

VANTAGE_INLINE std::vector<VoxelIndex> Situation::way_to(const VoxelIndex& goal) const {
  const ReachableSpace& space = reachable();
  if (!space.start() || (map_->frame().centre_of(goal) - map_->frame().centre_of(*space.start())).norm() <=
                            detail::kFarCells * map_->resolution_m()) {
    return GridPaths(space).to(goal);
  }
  const std::vector<VoxelIndex> blocks = ways().way(*space.start(), goal);
  std::vector<VoxelIndex> way;
  for (std::size_t at = 0; at + 1 < blocks.size();) {
    const std::size_t next = std::min(at + detail::kBlocksAtOnce, blocks.size() - 1);
    const std::vector<VoxelIndex> part = GridPaths(space, blocks[at]).to(blocks[next]);
    way.insert(way.end(), part.begin() + (at == 0 ? 0 : 1), part.end());
    at = next;
  }
  return way;
}

VANTAGE_INLINE std::optional<std::vector<Pose>> Situation::path_to(const Pose& view,
                                                                   std::span<const VoxelIndex> way) const {
  if (reachable().only_turns()) {
    return std::vector<Pose>{current_, view};
  }
  std::vector<VoxelIndex> shortest;
  if (way.empty()) {
    shortest = way_to(map_->frame().cell_of(view.translation()));
    way = shortest;
  }
  auto path = way.empty() ? std::nullopt : poses_along(*map_, platform(), current_, way, view);
  return path ? std::move(path) : platform().path(*map_, current_, view);
}

VANTAGE_INLINE const FollowingCaster& Situation::looking() const {
  if (!looking_follows_) {
    looking_.follow(*map_, setup_.sensor);
    looking_follows_ = true;
  }
  return looking_;
}

}  // namespace vantage
