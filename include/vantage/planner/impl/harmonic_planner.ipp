// SPDX-License-Identifier: MIT
#pragma once

// Shade & Newman 2011, "Choosing Where To Go: Complete 3D Exploration With Stereo", section II.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/view/impl/look_directions.hpp>

namespace vantage {
namespace detail {

// The viewpoints of all targets, without duplicates.
inline std::vector<VoxelIndex> viewpoints(const FrontierSurvey& survey) {
  std::vector<VoxelIndex> cells = survey.viewpoints();
  sort_unique(cells);
  return cells;
}

// Truncates the curve after its first point in this cell.
inline void cut_at(std::vector<Eigen::Vector3d>& curve, const VoxelFrame& frame, const VoxelIndex& cell) {
  const auto last = std::find_if(curve.begin(), curve.end(),
                                 [&](const Eigen::Vector3d& point) { return frame.cell_of(point) == cell; });
  if (last != curve.end()) {
    curve.erase(last + 1, curve.end());
  }
}

// The streamline as poses that look along it, one for every second point. None if a motion is not admitted.
inline std::optional<std::vector<Pose>> poses_of_curve(const OccupancyMap& map, const Platform& platform,
                                                       const Pose& current, const std::vector<Eigen::Vector3d>& curve,
                                                       const Pose& goal) {
  std::vector<Pose> poses{current};
  for (std::size_t i = 2; i < curve.size(); i += 2) {
    poses.push_back(platform.facing(curve[i], curve[i] - curve[i - 2]));
  }
  poses.push_back(goal);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (!platform.admits_motion(map, poses[i - 1], poses[i]) || !platform.admits(map, poses[i])) {
      return std::nullopt;
    }
  }
  return poses;
}

}  // namespace detail

VANTAGE_INLINE HarmonicPlanner::HarmonicPlanner(const PlannerSetup& setup, const HarmonicOptions& options)
    : FrontierPlanner(setup, options.survey), options_(options) {
  detail::harmonic_settings().validate(options);
  if (options.field.neumann == NeumannScheme::Mirror && options.field.solver != FieldSolver::GaussSeidel) {
    throw std::invalid_argument("HarmonicOptions::neumann is mirror, must be finite-volume with solver=multigrid");
  }
}

VANTAGE_INLINE void HarmonicPlanner::prepare(Plan& /*plan*/) { field_.reset(); }

VANTAGE_INLINE std::optional<ChosenView> HarmonicPlanner::choose(Plan& plan) {
  const FrontierSurvey& survey = situation().survey();
  const HarmonicStrategy& strategy = options_.strategy;
  std::uint64_t& operations = plan.statistics.ray_operations;
  std::vector<VoxelIndex> way{*situation().reachable().start()};
  if (std::optional<TargetView> look = look_again(operations)) {
    return ChosenView{.view = std::move(*look), .way = std::move(way)};
  }
  std::optional<FrontierTarget> wanted = survey.target_seen_from(way.back());
  if (!wanted) {  // otherwise the sensor looks from where it is
    const NearGoals near = sinks();
    if (strategy.shortest_way && near.goals.size() == 1) {  // descent would end there from everywhere
      way = situation().way_to(near.goals.front());
    } else {
      way = way_down(near, plan.statistics);
      if (strategy.shortest_way) {
        way = situation().way_to(way.back());
      }
    }
    wanted = strategy.look_early ? first_look(way, operations) : survey.target_seen_from(way.back());
  }
  ChosenView chosen{look_at(*wanted, operations)};
  if (field_ && field_->followed && !strategy.shortest_way) {
    const OccupancyMap& map = situation().map();
    detail::cut_at(field_->streamline, map.frame(), wanted->viewpoint);
    if (auto path = detail::poses_of_curve(map, situation().platform(), situation().current(), field_->streamline,
                                           chosen.view.view.pose)) {
      chosen.path = std::move(*path);
      return chosen;
    }
  }
  chosen.way = situation().way_to(wanted->viewpoint);
  return chosen;
}

VANTAGE_INLINE bool HarmonicPlanner::chooses_directions() const {
  return !std::isinf(options_.strategy.look_again_m3) &&
         detail::LookDirections::choosable(situation().map(), situation().sensor());
}

// A view from the current place, if its expected gain is at least look_again_m3.
VANTAGE_INLINE std::optional<TargetView> HarmonicPlanner::look_again(std::uint64_t& operations) const {
  const OccupancyMap& map = situation().map();
  const Eigen::Vector3d position = situation().current().translation();
  const VoxelIndex here = map.frame().cell_of(position);
  if (!chooses_directions() || here != *situation().reachable().start() || situation().tried().rests(here)) {
    return std::nullopt;
  }
  std::optional<detail::Look> look = detail::LookDirections(situation().surveyed(), position, operations)
                                         .best(situation().looking(), situation().setup().threads);
  const double cell_m3 = std::pow(map.resolution_m(), 3);
  return look && look->cells * cell_m3 >= options_.strategy.look_again_m3
             ? std::optional<TargetView>(std::move(look->seen))
             : std::nullopt;
}

// The view at the end of the path.
VANTAGE_INLINE TargetView HarmonicPlanner::look_at(const FrontierTarget& wanted, std::uint64_t& operations) const {
  if (chooses_directions()) {
    const Eigen::Vector3d position = situation().reachable().position_in(wanted.viewpoint);
    if (std::optional<detail::Look> look =
            detail::LookDirections(situation().surveyed(), position, operations)
                .best(situation().looking(), situation().setup().threads, wanted.unknown)) {
      return std::move(look->seen);
    }
  }
  return view_of_target(situation().surveyed(), wanted, operations);
}

// Whether `target` can be observed from the centre of `from`: the rule of FrontierSurvey, within the resolving range.
VANTAGE_INLINE bool HarmonicPlanner::can_look(const FrontierTarget& target, const VoxelIndex& from,
                                              std::uint64_t& operations) const {
  if (from == target.viewpoint) {
    return true;
  }
  const OccupancyMap& map = situation().map();
  const RangeSensor& sensor = situation().sensor();
  const Eigen::Vector3d position = situation().reachable().position_in(from);
  const Eigen::Vector3d line = map.frame().centre_of(target.unknown) - position;
  return line.norm() <= sensor.resolving_range_m(map.resolution_m()) &&
         !situation().tried().tried_from(target.unknown, from) && !situation().tried().rests(from) &&
         sees(map, sensor, situation().platform().facing(position, line), target.unknown, operations);
}

// The first cell on the path that sees the target frontier or, after look_spacing_m, any other target.
VANTAGE_INLINE FrontierTarget HarmonicPlanner::first_look(const std::vector<VoxelIndex>& way,
                                                          std::uint64_t& operations) const {
  const FrontierSurvey& survey = situation().survey();
  const VoxelFrame& frame = situation().map().frame();
  const auto looked_at_from = [](FrontierTarget target, const VoxelIndex& cell) {
    target.viewpoint = cell;
    return target;
  };
  const FrontierTarget wanted = *survey.target_seen_from(way.back());
  double gone_m = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    gone_m += i == 0 ? 0.0 : (frame.centre_of(way[i]) - frame.centre_of(way[i - 1])).norm();
    const auto in_sight = [&](const FrontierTarget& target) { return can_look(target, way[i], operations); };
    if (in_sight(wanted)) {
      return looked_at_from(wanted, way[i]);
    }
    if (gone_m >= options_.strategy.look_spacing_m) {
      const auto other = std::find_if(survey.targets.begin(), survey.targets.end(), in_sight);
      if (other != survey.targets.end()) {
        return looked_at_from(*other, way[i]);
      }
    }
  }
  return wanted;
}

// The sinks and the domain of the field: all viewpoints and the reachable space, or the viewpoints within detour_m of
// the nearest, and the cells that are nearer than these.
VANTAGE_INLINE NearGoals HarmonicPlanner::sinks() const {
  const ReachableSpace& reachable = situation().reachable();
  NearGoals all{detail::viewpoints(situation().survey()), {}};
  if (!std::isinf(options_.strategy.detour_m)) {
    return GridPaths(reachable).nearest_within(all.goals, options_.strategy.detour_m,
                                               situation().map().resolution_m());
  }
  reachable.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) { all.met.plane(brick) = cells; });
  return all;
}

// Solves the field. Returns the cells of its streamline from the start to a sink, or of the shortest path if the
// field is not followed.
VANTAGE_INLINE std::vector<VoxelIndex> HarmonicPlanner::way_down(const NearGoals& near, PlanStatistics& statistics) {
  LaplaceDomain domain;
  near.met.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) { domain.insert(brick, cells); });
  std::for_each(near.goals.begin(), near.goals.end(), [&](const VoxelIndex& goal) { domain.insert_sink(goal); });
  field_ = HarmonicField::solve(std::move(domain), *situation().reachable().start(), options_.field,
                                static_cast<std::size_t>(situation().setup().threads));
  statistics.solver_sweeps += field_->sweeps;
  statistics.ray_operations += field_->cell_updates;
  return field_->followed ? field_->follow(situation().map().frame(), situation().current().translation())
                          : GridPaths(situation().reachable()).to_nearest(detail::viewpoints(situation().survey()));
}

}  // namespace vantage
