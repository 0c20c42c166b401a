// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/motion_model.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/robot/trajectory.hpp>
#include <vantage/robot/turning.hpp>
#include <vector>

namespace vantage::detail {

/// A robot that follows paths in time: its position along a Trajectory, its orientation in parallel. While there is
/// time it looks as the path says, and turns to the last orientation in time to have it at the end.
class TimedRobot {
 public:
  /// At rest.
  TimedRobot(std::shared_ptr<const Platform> platform, const MotionModel& motion, const Pose& start);

  /// Since the start, seconds.
  [[nodiscard]] double time_s() const { return time_s_; }
  /// world_from_sensor.
  [[nodiscard]] Pose pose() const;
  /// Whether it is at rest at the end of its path, and looks where it is to look.
  [[nodiscard]] bool has_arrived() const;
  /// Whether the map still admits all that is left of its way.
  [[nodiscard]] bool way_is_free(const OccupancyMap& map) const;

  /// Follows another path from where it is now, in the motion it is in now. Returns whether it can; else it goes on.
  bool follow(const OccupancyMap& map, const std::vector<Pose>& path);
  /// Comes to rest as soon as the map admits it on its way or straight on; at once, where it admits neither.
  void brake(const OccupancyMap& map);
  /// Goes on until `time_s`; `visit` is told of poses so near to each other that the motion between them is straight.
  void advance(double time_s, const std::function<void(const Pose&)>& visit);

 private:
  struct Look {
    double until_s;  // on the trajectory
    Eigen::Matrix3d orientation;
  };
  [[nodiscard]] double elapsed_s() const { return time_s_ - started_s_; }
  [[nodiscard]] const Eigen::Matrix3d& looks_for();
  [[nodiscard]] Trajectory::Admits admits(const OccupancyMap& map) const;
  [[nodiscard]] bool admits_points(const OccupancyMap& map, const std::vector<Eigen::Vector3d>& points) const;

  std::shared_ptr<const Platform> platform_;
  MotionModel motion_;
  Trajectory trajectory_;
  Turning turning_;
  std::vector<Look> looks_;  // the last for the end
  bool looks_for_the_end_ = false;
  double started_s_ = 0.0;  // the trajectory
  double time_s_ = 0.0;
};

}  // namespace vantage::detail
