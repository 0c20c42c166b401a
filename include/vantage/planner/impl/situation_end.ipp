// SPDX-License-Identifier: MIT
#pragma once

// Plans without a target.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/planner/situation.hpp>
#include <vantage/robot/admitted_cells.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vantage/view/target_view.hpp>

#include <vantage/planner/impl/blocked_reasons.hpp>
#include <vantage/robot/impl/body_cells.hpp>

namespace vantage {
namespace detail {

// The reason for a plan without targets.
inline std::string reason_of(const FrontierSurvey& survey, const RangeSensor& sensor) {
  if (survey.frontier_cells == 0) {
    return "no frontier is left";
  }
  const Leftover& left = survey.leftover;
  return "no observable frontier is left; frontier cells given up: " + counted(left.unreachable, "unreachable, ") +
         counted(left.unobservable, "unobservable, ") + counted(left.in_vain, "looked at in vain") +
         (left.in_vain > 0 && !sensor.reports_no_return
              ? " (the sensor does not report rays without return: open space with no surface in range stays unknown)"
              : "") +
         (survey.exhausted ? "" : " (not every line of sight was tried)");
}

}  // namespace detail

VANTAGE_INLINE std::optional<Plan> Situation::end() {
  if (is_stuck_) {
    tried_.end_run();
    Plan plan = open_plan();
    plan.reason = detail::kDoesNotMove;
    return plan;
  }
  if (!survey_.targets.empty()) {
    return std::nullopt;
  }
  Plan plan = open_plan();
  if (map_->bounds().empty()) {
    plan.reason = "the map is empty: insert a scan, or declare the robot's surroundings free (assume_free)";
    return plan;
  }
  if (survey_.frontier_cells > 0) {
    if (!reachable().start()) {
      plan.reason = detail::kIsNotAdmitted;
      return plan;
    }
    for (const auto move : {&Situation::turn_on_the_spot, &Situation::step_aside, &Situation::look_closely,
                            &Situation::look_at_contested}) {
      if (std::optional<Plan> moves = (this->*move)()) {
        return moves;
      }
    }
    if (hardly_moves() && stands_beside_unknown()) {
      plan.reason =
          "the platform sees too little free space to move in: declare the space around it free (assume_free); " +
          detail::reason_of(survey_, sensor());
      return plan;
    }
    if (const std::size_t places = tried_.places_given_up(); places > 0) {
      tried_.end_run();
      plan.outcome = Outcome::Unreachable;
      plan.reason = "the robot does not get to " + detail::counted(places, "places with more to see; ") +
                    detail::reason_of(survey_, sensor());
      return plan;
    }
    if (const std::optional<VoxelIndex> beyond = place_cut_off()) {
      const Eigen::Vector3d at = map_->frame().centre_of(*beyond);
      plan.outcome = Outcome::Unreachable;
      plan.reason = "there is more to see from free space that is cut off, around (" + std::to_string(at.x()) + ", " +
                    std::to_string(at.y()) + ", " + std::to_string(at.z()) + "); " +
                    detail::reason_of(survey_, sensor());
      return plan;
    }
  }
  plan.outcome = Outcome::Explored;
  plan.reason = detail::reason_of(survey_, sensor());
  return plan;
}

// The size of the space that the body needs.
VANTAGE_INLINE double Situation::body_m() const {
  return 2.0 * detail::clear_half_m(setup_.platform->body_box(current_), *map_).maxCoeff();
}

// Whether all reachable cells lie within the size of the body, or within the minimum range of the sensor, plus one
// cell.
VANTAGE_INLINE bool Situation::hardly_moves() const {
  const double little_m = std::max(body_m(), sensor().min_range_m) + map_->resolution_m();
  if (static_cast<double>(reachable().size()) > std::pow(2.0 * little_m / map_->resolution_m() + 2.0, 3)) {
    return false;
  }
  const std::vector<VoxelIndex> cells = reachable().cells();
  return std::all_of(cells.begin(), cells.end(), [&](const VoxelIndex& cell) {
    return (reachable().position_in(cell) - current_.translation()).norm() <= little_m;
  });
}

// Whether the body would touch an unknown cell beside a free one if it moved one cell further. If not, only known
// cells are in its way, and there is nothing to declare free.
VANTAGE_INLINE bool Situation::stands_beside_unknown() const {
  const double near_m = 0.5 * body_m() + map_->resolution_m();
  const std::vector<VoxelIndex> places = reachable().cells();
  const auto is_near = [&](const VoxelIndex& cell) {
    const Box box = map_->frame().box_of(cell);
    return std::any_of(places.begin(), places.end(), [&](const VoxelIndex& place) {
      return box.distance_to(reachable().position_in(place)) < near_m;
    });
  };
  return std::any_of(frontier_cells_.begin(), frontier_cells_.end(), [&](const VoxelIndex& cell) {
    return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
      return map_->in_region(cell + step) && map_->at(cell + step) == Occupancy::Unknown && is_near(cell + step);
    });
  });
}

// A sensor with a narrow field of view does not see free space beside the body, so it first looks in all horizontal
// directions. Views overlap by a fifth.
VANTAGE_INLINE std::optional<Plan> Situation::turn_on_the_spot() {
  if (sensor().looks_all_around() || !hardly_moves() || tried_.rests(map_->frame().cell_of(current_.translation()))) {
    return std::nullopt;
  }
  constexpr double kFullTurnRad = 2.0 * std::numbers::pi;
  const double step_rad = 0.8 * sensor().horizontal_angle_rad();
  const auto turns = static_cast<int>(std::ceil(kFullTurnRad / step_rad));
  const Eigen::Vector3d here = current_.translation();
  for (int turn = 1; turn < turns; ++turn) {
    const Eigen::AngleAxisd by(kFullTurnRad * turn / turns, Eigen::Vector3d::UnitZ());
    const Pose view = setup_.platform->facing(here, by * optical_axis(current_));
    const auto looks_there = [&](const Pose& scanned) {
      return (scanned.translation() - here).norm() <= map_->resolution_m() &&
             optical_axis(scanned).dot(optical_axis(view)) > std::cos(0.5 * step_rad);
    };
    if (std::none_of(tried_.scanned_from().begin(), tried_.scanned_from().end(), looks_there) &&
        setup_.platform->admits(*map_, view)) {
      Plan plan = open_plan();
      plan.outcome = Outcome::Move;
      plan.goal.pose = view;
      plan.path = {current_, view};
      plan.reason = "a turn on the spot: nothing is in sight that could be looked at or driven to";
      return plan;
    }
  }
  return std::nullopt;
}

// Reachable cells are connected across faces. A body may also fit aslant into a neighbouring cell that is not
// reachable in this sense, for example after somebody carried it. It goes there if more can be seen from the cells
// around it.
VANTAGE_INLINE std::optional<Plan> Situation::step_aside() {
  const auto is_cut_off = [&](const VoxelIndex& cell) {
    return reachable().admitted().contains(cell) && !reachable().contains(cell);
  };
  const VoxelIndex home = map_->frame().cell_of(current_.translation());
  BrickSet taken;  // what is connected to a neighbour is surveyed once
  for (const VoxelIndex& step : kAllNeighbours) {
    Pose there = current_;
    there.translation() = map_->frame().centre_of(home + step);
    if (!is_cut_off(home + step) || taken.contains(home + step) || tried_.rests(home + step) ||
        !setup_.platform->admits_motion(*map_, current_, there)) {
      continue;
    }
    std::vector<VoxelIndex> around{home + step};
    taken.insert(around.front());
    for (std::size_t next = 0; next < around.size(); ++next) {
      for (const VoxelIndex& across : kFaceNeighbours) {
        const VoxelIndex cell = around[next] + across;
        if (is_cut_off(cell) && !taken.contains(cell)) {
          taken.insert(cell);
          around.push_back(cell);
        }
      }
    }
    if (viewpoint_among(std::move(around))) {
      Plan plan = open_plan();
      plan.outcome = Outcome::Move;
      plan.goal.pose = there;
      plan.path = {current_, there};
      plan.reason = "a step into free space from which there is more to see";
      return plan;
    }
  }
  return std::nullopt;
}

// The nearest view of a cell that was looked at in vain, but not closely.
VANTAGE_INLINE std::optional<Plan> Situation::look_closely() {
  FrontierSurvey survey{.targets = surveyor_.looks_to_take_closely(*map_, tried_, frontier_cells_)};
  while (!survey.targets.empty()) {
    const std::vector<VoxelIndex> way = GridPaths(reachable()).to_nearest(survey.viewpoints());
    const std::optional<FrontierTarget> nearest = survey.target_seen_from(way.back());
    Plan plan = open_plan();
    TargetView view = view_of_target({*map_, sensor(), platform(), reachable(), survey, tried_}, *nearest,
                                     plan.statistics.ray_operations);
    if (std::optional<std::vector<Pose>> path = path_to(view.view.pose, way)) {
      plan.outcome = Outcome::Move;
      plan.goal = view.view;
      plan.path = std::move(*path);
      plan.sought = std::move(view.unknown);
      plan.reason = "a closer look at " + detail::counted(plan.sought.size(), "cells that were looked at in vain");
      return plan;
    }
    std::erase_if(survey.targets, [&](const FrontierTarget& one) { return one.viewpoint == nearest->viewpoint; });
  }
  return std::nullopt;
}

// A viewpoint of a frontier cell in admitted cells that are not connected to the current place, or in cells that
// would be admitted if no cell was contested.
VANTAGE_INLINE std::optional<VoxelIndex> Situation::place_cut_off() const {
  if (const auto place = viewpoint_among(out_of_reach(reachable().admitted().cells().cells(), 0.0))) {
    return place;
  }
  AdmittedCells opened;
  if (const std::optional<OccupancyMap> open = map_without_contested()) {
    opened.follow(*open, platform());
  }
  return viewpoint_among(out_of_reach(opened.cells().cells(), body_m()));
}

// Those of these places that are further away than this from every reachable cell, along an axis.
VANTAGE_INLINE std::vector<VoxelIndex> Situation::out_of_reach(std::vector<VoxelIndex> places, double metres) const {
  const std::int32_t near = map_->frame().cells_up_to(metres);
  std::erase_if(places, [&](const VoxelIndex& cell) {
    return reachable().any_in(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(near));
  });
  return places;
}

// The first of these places from which an observable frontier cell is in sight.
VANTAGE_INLINE std::optional<VoxelIndex> Situation::viewpoint_among(std::vector<VoxelIndex> places) const {
  if (places.empty()) {
    return std::nullopt;
  }
  std::sort(places.begin(), places.end(), RasterOrder{});
  FrontierSurveyor surveyor(setup_.platform, setup_.sensor, options_);
  const FrontierSurvey survey = surveyor.survey_from(places, *map_, tried_, frontier_cells_);
  return survey.targets.empty() ? std::nullopt : std::optional(survey.targets.front().viewpoint);
}

}  // namespace vantage
