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

/// Where a robot is and how fast it goes, in the world.
struct MotionState {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    ///< of the sensor
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  ///< of the same
};

/// A way in time: pieces of constant acceleration, from a state to rest. On straight pieces the robot speeds up and
/// brakes; corners are rounded by parabolas that it enters and leaves at the same speed, at the full acceleration.
class Trajectory {
 public:
  /// Whether the robot may go straight from one position to the other.
  using Admits = std::function<bool(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m)>;

  /// Stays where it is.
  explicit Trajectory(const Eigen::Vector3d& position_m) : end_m_(position_m) {}

  /// From `start` to rest at the last of `corners`, at least one, by way of those between, which are rounded as far
  /// as the robot may, or stopped at. The robot may be off the first corner or on the move: it then swings to one of
  /// the first four corners, wherever that takes the least time, or brakes and goes back to one. Of all the speeds at
  /// the corners, in 16 steps each, those that take the least time in sum. None if no way of swinging over is
  /// admitted; the motions between `corners` are taken as admitted.
  [[nodiscard]] static std::optional<Trajectory> through(const MotionState& start,
                                                         std::span<const Eigen::Vector3d> corners,
                                                         const MotionModel& motion, const Admits& admits);
  /// The same by way of the positions of a path. The orientations do not count.
  [[nodiscard]] static std::optional<Trajectory> through(const MotionState& start, std::span<const Pose> path,
                                                         const MotionModel& motion, const Admits& admits);

  /// The same until `time_s`, then straight on to rest.
  [[nodiscard]] Trajectory braked(double time_s, const MotionModel& motion) const;

  /// From the start to rest.
  [[nodiscard]] double duration_s() const { return duration_s_; }
  /// The state at a time, >= 0; at rest at the end after it.
  [[nodiscard]] MotionState at(double time_s) const;
  /// When it is nearest to each of the corners that it was made through; 0 for those left out.
  [[nodiscard]] const std::vector<double>& passes_at_s() const { return passes_at_s_; }
  /// Points from `time_s` on to the end, so near to each other that the chords between them leave the way by no more
  /// than 0.1 mm.
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
  // Straight on from a position, within the limits, and as fast as they allow.
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
