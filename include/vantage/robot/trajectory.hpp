// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/robot/motion_model.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Position and velocity of the sensor in the world frame.
struct MotionState {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    ///< position, metres
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  ///< velocity, metres per second
};

/// A motion over time, in pieces of constant acceleration, from a state to rest. On straight pieces the robot speeds
/// up and brakes. Corners are rounded by parabolas at full acceleration, entered and left at the same speed.
class Trajectory {
 public:
  /// Whether the robot may move straight from one position to the other (world, metres).
  using Admits = std::function<bool(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m)>;

  /// A trajectory of duration 0 that rests at `position_m` (world, metres).
  explicit Trajectory(const Eigen::Vector3d& position_m) : end_m_(position_m) {}

  /// From `start` to rest at the last of `corners` (world, metres; at least one), through the corners between. These
  /// are rounded as far as `admits` allows; otherwise the robot stops there. If the start is not the first corner, or
  /// the robot moves, the trajectory first joins the corners at one of the first four, the one of least total time,
  /// by a curve or after braking. The speeds at the corners, in 16 steps each, minimise the total time. None if no
  /// such joining motion is admitted. The straight motions between `corners` are not checked.
  [[nodiscard]] static std::optional<Trajectory> through(const MotionState& start,
                                                         std::span<const Eigen::Vector3d> corners,
                                                         const MotionModel& motion, const Admits& admits);
  /// The trajectory through the positions of a path. Its orientations are ignored.
  [[nodiscard]] static std::optional<Trajectory> through(const MotionState& start, std::span<const Pose> path,
                                                         const MotionModel& motion, const Admits& admits);

  /// This trajectory until `time_s`, then straight on while braking to rest.
  [[nodiscard]] Trajectory braked(double time_s, const MotionModel& motion) const;

  /// Time from the start to rest, seconds.
  [[nodiscard]] double duration_s() const { return duration_s_; }
  /// The state `time_s` seconds (>= 0) after the start. After `duration_s` it is at rest at the end.
  [[nodiscard]] MotionState at(double time_s) const;
  /// For each corner given to `through`: the time, seconds, at which the trajectory is nearest to it; 0 for a
  /// corner that was left out.
  [[nodiscard]] const std::vector<double>& passes_at_s() const { return passes_at_s_; }
  /// Points from `time_s` (seconds) to the end, world, metres, so close that the chords between them are within
  /// 0.1 mm of the curve.
  [[nodiscard]] std::vector<Eigen::Vector3d> points_from(double time_s) const;

 private:
  struct Piece {
    double starts_s;
    double lasts_s;
    MotionState from;
    Eigen::Vector3d acceleration_m_s2;
    bool is_straight;
  };
  class Search;
  void add(double lasts_s, const MotionState& from, const Eigen::Vector3d& acceleration_m_s2, bool is_straight);
  // Adds a straight motion from a position, as fast as the limits allow.
  void add_straight(const Eigen::Vector3d& from_m, const Eigen::Vector3d& direction, double length_m,
                    double speed_m_s, double last_speed_m_s, const MotionModel& motion);

  std::vector<Piece> pieces_;
  std::vector<double> passes_at_s_;
  Eigen::Vector3d end_m_;
  double duration_s_ = 0.0;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/trajectory.ipp>
#endif
