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
#include <vantage/planner/looks.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/planner/impl/planner_tables.hpp>

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

VANTAGE_INLINE PlanStatistics HarmonicPlanner::prepare(const Situation& /*situation*/) {
  field_.reset();
  return {};
}

VANTAGE_INLINE Choice HarmonicPlanner::choose(const Situation& situation) {
  const FrontierSurvey& survey = situation.survey();
  const HarmonicStrategy& strategy = options_.strategy;
  Choice choice{.way = {*situation.reachable().start()}};
  std::vector<VoxelIndex>& way = choice.way;
  std::uint64_t& operations = choice.statistics.ray_operations;
  if ((choice.view = look_around(situation, strategy.look_again_m3, operations))) {
    return choice;
  }
  std::optional<FrontierTarget> wanted = survey.target_seen_from(way.back());
  if (!wanted) {  // otherwise the sensor looks from where it is
    const NearGoals near = sinks(situation);
    if (strategy.shortest_way && near.goals.size() == 1) {  // descent would end there from everywhere
      way = situation.way_to(near.goals.front());
    } else {
      way = way_down(situation, near, choice.statistics);
      if (strategy.shortest_way) {
        way = situation.way_to(way.back());
      }
    }
    wanted = strategy.look_early ? look_early(situation, way, operations) : survey.target_seen_from(way.back());
  }
  const bool looks_around = !std::isinf(strategy.look_again_m3);
  choice.view = looks_around ? best_look_at(situation, *wanted, operations)
                             : view_of_target(situation.surveyed(), *wanted, operations);
  if (field_ && field_->followed && !strategy.shortest_way) {
    const OccupancyMap& map = situation.map();
    detail::cut_at(field_->streamline, map.frame(), wanted->viewpoint);
    if (auto path = detail::poses_of_curve(map, situation.platform(), situation.current(), field_->streamline,
                                           choice.view->view.pose)) {
      choice.path = std::move(*path);
      return choice;
    }
  }
  way = situation.way_to(wanted->viewpoint);
  return choice;
}

// The sinks and the domain of the field: all viewpoints and the reachable space, or the viewpoints within detour_m of
// the nearest, and the cells that are nearer than these.
VANTAGE_INLINE NearGoals HarmonicPlanner::sinks(const Situation& situation) const {
  const ReachableSpace& reachable = situation.reachable();
  NearGoals all{detail::viewpoints(situation.survey()), {}};
  if (!std::isinf(options_.strategy.detour_m)) {
    return GridPaths(reachable).nearest_within(all.goals, options_.strategy.detour_m, situation.map().resolution_m());
  }
  reachable.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) { all.met.plane(brick) = cells; });
  return all;
}

// Solves the field. Returns the cells of its streamline from the start to a sink, or of the shortest path if the
// field is not followed.
VANTAGE_INLINE std::vector<VoxelIndex> HarmonicPlanner::way_down(const Situation& situation, const NearGoals& near,
                                                                 PlanStatistics& statistics) {
  LaplaceDomain domain;
  near.met.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) { domain.insert(brick, cells); });
  std::for_each(near.goals.begin(), near.goals.end(), [&](const VoxelIndex& goal) { domain.insert_sink(goal); });
  field_ = HarmonicField::solve(std::move(domain), *situation.reachable().start(), options_.field,
                                static_cast<std::size_t>(situation.setup().threads));
  statistics.solver_sweeps += field_->sweeps;
  statistics.ray_operations += field_->cell_updates;
  return field_->followed ? field_->follow(situation.map().frame(), situation.current().translation())
                          : GridPaths(situation.reachable()).to_nearest(detail::viewpoints(situation.survey()));
}

}  // namespace vantage
