// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vantage/geometry/pose.hpp>
#include <vantage/robot/motion_model.hpp>
#include <vantage/robot/trajectory.hpp>
#include <vector>

namespace vantage::detail {

/// How a robot moves while it follows the latest path that was planned, as its motion model has it: a host tells
/// where the robot is, but not how fast it goes.
class EstimatedMotion {
 public:
  /// The robot sets off along `path`, at least one pose, in the motion that it was in at the first of them.
  void follow(const std::vector<Pose>& path, const MotionModel& motion) {
    const auto anywhere = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return true; };
    stops_within_m_ = 0.5 * motion.max_speed_m_s * motion.max_speed_m_s / motion.max_acceleration_m_s2;
    const Eigen::Vector3d start = path.front().translation();
    way_ = Trajectory::through({start, velocity_at(start)}, path, motion, anywhere)
               .value_or(Trajectory(path.back().translation()));
  }

  /// Its velocity where it comes nearest to a position, metres per second. Zero if it comes no nearer than the
  /// distance in which it can stop: then it does not follow the path.
  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& position_m) const {
    constexpr double kStepS = 0.05;
    constexpr double kMostSteps = 1000.0;
    const auto steps = static_cast<int>(std::min(std::ceil(way_.duration_s() / kStepS), kMostSteps));
    MotionState nearest;
    double least_m = stops_within_m_;
    for (int step = 0; step < steps; ++step) {
      const MotionState state = way_.at(way_.duration_s() * step / steps);
      if (const double off_m = (state.position_m - position_m).norm(); off_m < least_m) {
        least_m = off_m;
        nearest = state;
      }
    }
    return nearest.velocity_m_s;
  }

 private:
  Trajectory way_{Eigen::Vector3d::Zero()};
  double stops_within_m_ = 0.0;
};

}  // namespace vantage::detail
