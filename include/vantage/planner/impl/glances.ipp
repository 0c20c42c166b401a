// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/glances.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vantage/robot/trajectory.hpp>

#include <vantage/geometry/impl/pose_distance.hpp>

namespace vantage::detail {

// Between places for glances. The path is planned again before the robot has passed that many.
inline constexpr double kBetweenGlancesM = 0.4;
inline constexpr std::size_t kMostPlacesForGlances = 8;
inline constexpr std::size_t kMostGlances = 3;

// A corner of a path, or a place between corners.
struct PathPoint {
  Pose pose;
  bool is_corner;
  double passed_at_s = 0.0;
};

inline std::vector<PathPoint> points_of(const std::vector<Pose>& path, const MotionModel& motion,
                                        const Eigen::Vector3d& velocity_m_s) {
  std::vector<PathPoint> points{{path.front(), true}};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector3d from = path[i - 1].translation();
    const Eigen::Vector3d leg = path[i].translation() - from;
    const double parts = std::ceil(leg.norm() / kBetweenGlancesM);
    for (double part = 1.0; part < parts && points.size() <= kMostPlacesForGlances; ++part) {
      points.push_back({path[i], false});
      points.back().pose.translation() = from + leg * (part / parts);
    }
    points.push_back({path[i], true});
  }
  std::vector<Pose> poses(points.size());
  std::transform(points.begin(), points.end(), poses.begin(), [](const PathPoint& point) { return point.pose; });
  const auto anywhere = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return true; };
  const std::optional<Trajectory> way =
      Trajectory::through({path.front().translation(), velocity_m_s}, poses, motion, anywhere);
  for (std::size_t i = 0; way && i < points.size(); ++i) {
    points[i].passed_at_s = way->passes_at_s()[i];
  }
  return points;
}

// A view from a point of a path.
struct Glance {
  std::size_t point;
  TourView view;
};

inline std::vector<Glance> glances_from(const std::vector<PathPoint>& points, const TourViews& parts,
                                        const Situation& situation, std::uint64_t& operations) {
  std::vector<Glance> glances;
  for (std::size_t i = 1; i + 1 < points.size() && i <= kMostPlacesForGlances; ++i) {
    const Eigen::Vector3d position = points[i].pose.translation();
    const VoxelIndex place = situation.map().frame().cell_of(position);
    for (TourView& view : parts.views_from(place, position, situation, operations)) {
      glances.push_back({i, std::move(view)});
    }
  }
  return glances;
}

// The orientation that the sensor has at a point.
struct Aim {
  std::size_t point;
  Pose pose;
};

// The aims at the ends of a path and some of the glances between them, in the order of the path.
inline std::vector<Aim> with_best_of(const std::vector<Glance>& glances, const std::vector<PathPoint>& points,
                                     const TourViews& parts, const MotionModel& motion) {
  std::vector<Aim> aims{{0, points.front().pose}, {points.size() - 1, points.back().pose}};
  std::vector<bool> is_seen(parts.unknown.size());
  const auto can_turn = [&](const Aim& from, const Aim& to) {  // so that a glance lasts for a scan
    const double time_s = points[to.point].passed_at_s - points[from.point].passed_at_s;
    return motion.turn_time_s(angle_rad(from.pose, to.pose)) + 0.5 / motion.scan_rate_hz <= time_s;
  };
  while (aims.size() < 2 + kMostGlances) {
    const Glance* best = nullptr;
    auto before_best = aims.end();
    double most = 0.0;
    for (const Glance& glance : glances) {
      const Aim aim{glance.point, glance.view.pose};
      const auto after =
          std::find_if(aims.begin(), aims.end() - 1, [&](const Aim& other) { return other.point >= aim.point; });
      if (!can_turn(*(after - 1), aim) || !can_turn(aim, *after)) {
        continue;
      }
      double sees = 0.0;
      for (const std::uint32_t number : glance.view.sees) {
        sees += is_seen[number] ? 0.0 : parts.shares[number];
      }
      if (sees > most) {
        most = sees;
        best = &glance;
        before_best = after;
      }
    }
    if (best == nullptr) {
      break;
    }
    aims.insert(before_best, {best->point, best->view.pose});
    for (const std::uint32_t number : best->view.sees) {
      is_seen[number] = true;
    }
  }
  return aims;
}

VANTAGE_INLINE std::vector<Pose> with_glances(const std::vector<Pose>& path, const TourViews& parts,
                                              const Situation& situation, const Eigen::Vector3d& velocity_m_s,
                                              std::uint64_t& operations) {
  const MotionModel& motion = *situation.setup().motion;
  const std::vector<PathPoint> points = points_of(path, motion, velocity_m_s);
  const std::vector<Aim> aims =
      with_best_of(glances_from(points, parts, situation, operations), points, parts, motion);
  std::vector<Pose> glancing{path.front()};
  auto next = aims.begin() + 1;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const bool is_last = next + 1 == aims.end();
    const bool is_glance = !is_last && next->point == i;
    if (points[i].is_corner || is_glance) {
      glancing.push_back(points[i].pose);
      if (!is_last) {
        glancing.back().linear() = next->pose.linear();
      }
    }
    next += is_glance ? 1 : 0;
  }
  const auto admits = [&](const Pose& from, const Pose& to) {
    return situation.platform().admits(situation.map(), to) &&
           situation.platform().admits_motion(situation.map(), from, to);
  };
  const bool is_admitted =
      std::adjacent_find(glancing.begin(), glancing.end(), std::not_fn(admits)) == glancing.end();
  return is_admitted ? glancing : path;
}

}  // namespace vantage::detail
