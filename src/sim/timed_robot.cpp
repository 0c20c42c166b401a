// SPDX-License-Identifier: MIT
#include "sim/timed_robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vantage/robot/impl/steady_motion.hpp>

namespace vantage::detail {
namespace {

constexpr double kTurnStepS = 0.02;  // the longest for turning
constexpr double kLooksThereRad = 1e-6;

Pose pose_at(const Eigen::Vector3d& position_m) {
  Pose pose = Pose::Identity();
  pose.translation() = position_m;
  return pose;
}

}  // namespace

TimedRobot::TimedRobot(std::shared_ptr<const Platform> platform, const MotionModel& motion, const Pose& start)
    : platform_(std::move(platform)),
      motion_(motion),
      trajectory_(start.translation()),
      turning_(start.linear()),
      looks_{{0.0, start.linear()}} {}

Pose TimedRobot::pose() const {
  Pose pose = pose_at(trajectory_.at(elapsed_s()).position_m);
  pose.linear() = turning_.orientation();
  return pose;
}

bool TimedRobot::has_arrived() const {
  return elapsed_s() >= trajectory_.duration_s() &&
         turning_.angle_to_rad(looks_.back().orientation) <= kLooksThereRad;
}

Trajectory::Admits TimedRobot::admits(const OccupancyMap& map) const {
  return [this, &map](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return platform_->admits_motion(map, pose_at(from), pose_at(to));
  };
}

bool TimedRobot::admits_points(const OccupancyMap& map, const std::vector<Eigen::Vector3d>& points) const {
  return std::adjacent_find(points.begin(), points.end(), std::not_fn(admits(map))) == points.end();
}

bool TimedRobot::way_is_free(const OccupancyMap& map) const {
  return admits_points(map, trajectory_.points_from(elapsed_s()));
}

bool TimedRobot::follow(const OccupancyMap& map, const std::vector<Pose>& path) {
  std::optional<Trajectory> next = Trajectory::through(trajectory_.at(elapsed_s()), path, motion_, admits(map));
  if (!next) {
    return false;
  }
  trajectory_ = std::move(*next);
  started_s_ = time_s_;
  looks_for_the_end_ = false;
  looks_.clear();
  for (std::size_t i = 0; i < path.size(); ++i) {
    looks_.push_back({trajectory_.passes_at_s()[i], path[i].linear()});
  }
  return true;
}

void TimedRobot::brake(const OccupancyMap& map) {
  constexpr double kLaterS = 0.05;
  const double now_s = elapsed_s();
  const double left_s = std::max(0.0, trajectory_.duration_s() - now_s);
  for (int later = 0; later * kLaterS < left_s; ++later) {
    const Trajectory braked = trajectory_.braked(now_s + later * kLaterS, motion_);
    if (admits_points(map, braked.points_from(now_s))) {
      trajectory_ = braked;
      return;
    }
  }
  trajectory_ = trajectory_.braked(now_s, motion_);
}

// The orientation of the corner that comes next, but of the end as soon as that takes all the time there is.
const Eigen::Matrix3d& TimedRobot::looks_for() {
  const double left_s = trajectory_.duration_s() - elapsed_s();
  looks_for_the_end_ = looks_for_the_end_ ||
                       motion_.turn_time_s(turning_.angle_to_rad(looks_.back().orientation)) + kTurnStepS >= left_s;
  const auto next =
      std::find_if(looks_.begin(), looks_.end() - 1, [&](const Look& look) { return look.until_s > elapsed_s(); });
  return looks_for_the_end_ ? looks_.back().orientation : next->orientation;
}

void TimedRobot::advance(double time_s, const std::function<void(const Pose&)>& visit) {
  const double longest_s = std::min(kTurnStepS, std::sqrt(8.0 * kChordM / motion_.max_acceleration_m_s2));
  const double whole_s = time_s - time_s_;
  const auto steps = static_cast<int>(std::ceil(whole_s / longest_s));
  const double from_s = time_s_;
  for (int step = 1; step <= steps; ++step) {
    turning_.advance(looks_for(), whole_s / steps, motion_);
    time_s_ = from_s + whole_s * step / steps;
    visit(pose());
  }
}

}  // namespace vantage::detail
