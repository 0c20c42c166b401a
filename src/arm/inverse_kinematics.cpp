// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vantage/arm/kinematic_chain.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "arm/chain_parts.hpp"

namespace vantage {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Weight of a rotation: one radian counts like half a metre, about the movement that it causes at the end of an arm.
constexpr double kMetresPerRadian = 0.5;

// The rotation vector that turns the z axis of a frame to `wanted_axis`, in the coordinates of that frame.
Eigen::Vector3d turn_of_axis(const Eigen::Vector3d& wanted_axis) {
  const Eigen::Vector3d across(-wanted_axis.y(), wanted_axis.x(), 0.0);  // cross product of z and wanted_axis
  const double sine = across.norm();
  if (sine < 1e-12) {
    return wanted_axis.z() > 0.0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(std::numbers::pi, 0.0, 0.0);
  }
  return across / sine * std::atan2(sine, wanted_axis.z());
}

// Damped least squares. The number of joints is a compile-time constant, or Eigen::Dynamic.
template <int kCount>
class Search {
 public:
  Search(const JointFrames& frames, const std::vector<JointRange>& ranges, const Pose& target,
         const InverseOptions& options)
      : frames_(frames),
        ranges_(ranges),
        target_turn_(target.linear()),
        target_place_(target.translation()),
        options_(options) {}

  std::optional<Joints> from(std::span<const double> guess) {
    Values joints = Eigen::Map<const Values>(guess.data(), static_cast<Eigen::Index>(guess.size()));
    clamp(joints);
    Station station = at(joints);
    double damping = 1e-3;
    for (int i = 0; i < options_.max_iterations && !done(station.error); ++i) {
      const Columns local = jacobian(station);
      Square normal = local.transpose() * local;
      normal.diagonal().array() += damping;
      Values tried = joints;
      tried += normal.ldlt().solve(local.transpose() * station.error);
      clamp(tried);
      Station next = at(tried);
      if (next.error.squaredNorm() < station.error.squaredNorm()) {
        joints = tried;
        std::swap(station, next);
        damping = std::max(damping / 5.0, 1e-12);
      } else {
        damping *= 4.0;
        if (damping > 1e4) {
          break;
        }
      }
    }
    if (!done(station.error)) {
      return std::nullopt;
    }
    return Joints(joints.begin(), joints.end());
  }

 private:
  using Values = Eigen::Matrix<double, kCount, 1>;
  using Square = Eigen::Matrix<double, kCount, kCount>;
  using Places = Eigen::Matrix<double, 3, kCount>;
  using Columns = Eigen::Matrix<double, 6, kCount>;
  // The state of the chain for one set of joint values.
  struct Station {
    Places axes;  // joint axes in the frame of the base
    Places origins;
    JointFrames::Frame sensor;
    Vector6 error;  // difference to the target in the sensor frame; rotations scaled to metres
  };

  void clamp(Values& joints) const {
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      double& value = joints[static_cast<Eigen::Index>(i)];
      value = std::clamp(value, ranges_[i].min, ranges_[i].max);
    }
  }
  [[nodiscard]] Station at(const Values& joints) const {
    Station station;
    station.axes.resize(3, joints.size());
    station.origins.resize(3, joints.size());
    frames_.follow({joints.data(), static_cast<std::size_t>(joints.size())},
                   [&](std::size_t i, const JointFrames::Frame& frame) {
                     if (i > 0) {
                       const auto column = static_cast<Eigen::Index>(i - 1);
                       station.axes.col(column) = frame.turn.col(2);
                       station.origins.col(column) = frame.place;
                     }
                     if (i == frames_.size()) {
                       station.sensor = frames_.sensor(frame);
                     }
                   });
    const Eigen::Matrix3d sensor_from_base = station.sensor.turn.transpose();
    const Eigen::Matrix3d turn = sensor_from_base * target_turn_;
    station.error.template head<3>() = sensor_from_base * (target_place_ - station.sensor.place);
    if (options_.free_roll) {
      station.error.template tail<3>() = kMetresPerRadian * turn_of_axis(turn.col(2));
    } else {
      const Eigen::AngleAxisd missing(turn);
      station.error.template tail<3>() = kMetresPerRadian * missing.angle() * missing.axis();
    }
    return station;
  }
  // Jacobian of the sensor motion with respect to the joints, in the sensor frame.
  [[nodiscard]] Columns jacobian(const Station& station) const {
    const Eigen::Matrix3d sensor_from_base = station.sensor.turn.transpose();
    Columns local(6, station.axes.cols());
    for (Eigen::Index i = 0; i < local.cols(); ++i) {
      const Eigen::Vector3d axis = sensor_from_base * station.axes.col(i);
      if (frames_.slides(static_cast<std::size_t>(i))) {
        local.col(i) << axis, Eigen::Vector3d::Zero();
      } else {
        const Eigen::Vector3d arm = sensor_from_base * (station.sensor.place - station.origins.col(i));
        local.col(i) << axis.cross(arm), kMetresPerRadian * axis;
      }
    }
    if (options_.free_roll) {
      local.row(5).setZero();
    }
    return local;
  }
  [[nodiscard]] bool done(const Vector6& error) const {
    return error.head<3>().norm() <= options_.tolerance_m &&
           error.tail<3>().norm() <= kMetresPerRadian * options_.tolerance_rad;
  }

  const JointFrames& frames_;
  const std::vector<JointRange>& ranges_;
  Eigen::Matrix3d target_turn_;
  Eigen::Vector3d target_place_;
  InverseOptions options_;
};

}  // namespace

std::optional<Joints> KinematicChain::inverse(const Pose& base_from_sensor, std::span<const double> guess,
                                              const InverseOptions& options) const {
  detail::require_option(options.max_iterations > 0, "InverseOptions::max_iterations", options.max_iterations, "> 0");
  detail::require_option(options.tolerance_m > 0.0, "InverseOptions::tolerance_m", options.tolerance_m, "> 0");
  detail::require_option(options.tolerance_rad > 0.0, "InverseOptions::tolerance_rad", options.tolerance_rad, "> 0");
  if (guess.size() != joint_count()) {
    throw std::invalid_argument("KinematicChain::inverse: " + std::to_string(guess.size()) + " values for " +
                                std::to_string(joint_count()) + " joints");
  }
  if (!is_rigid(base_from_sensor)) {
    return std::nullopt;
  }
  const auto search = [&](auto count) {
    return Search<decltype(count)::value>(parts_->frames, parts_->ranges, base_from_sensor, options).from(guess);
  };
  // Most arms have five to seven joints. With fixed sizes their matrices need no heap memory.
  switch (guess.size()) {
    case 5:
      return search(std::integral_constant<int, 5>{});
    case 6:
      return search(std::integral_constant<int, 6>{});
    case 7:
      return search(std::integral_constant<int, 7>{});
    default:
      return search(std::integral_constant<int, Eigen::Dynamic>{});
  }
}

}  // namespace vantage
