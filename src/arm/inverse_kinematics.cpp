// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <numbers>
#include <stdexcept>
#include <vantage/arm/kinematic_chain.hpp>

#include "arm/chain_parts.hpp"
#include "map/option_rule.hpp"

namespace vantage {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// A radian counts as much as half a metre: about what it moves at the end of an arm.
constexpr double kMetresPerRadian = 0.5;

// The turn that takes the optical axis of one frame to that of the other, in the first one's coordinates.
Eigen::Vector3d turn_of_axis(const Eigen::Vector3d& wanted_axis) {
  const Eigen::Vector3d across(-wanted_axis.y(), wanted_axis.x(), 0.0);  // z x wanted
  const double sine = across.norm();
  if (sine < 1e-12) {
    return wanted_axis.z() > 0.0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(std::numbers::pi, 0.0, 0.0);
  }
  return across / sine * std::atan2(sine, wanted_axis.z());
}

class Search {
 public:
  Search(const KDL::Chain& chain, const std::vector<JointRange>& ranges, const Pose& target,
         const InverseOptions& options)
      : ranges_(ranges), target_(target), options_(options), forward_(chain), jacobian_(chain) {}

  std::optional<Joints> from(KDL::JntArray joints) {
    const auto count = joints.data.size();
    clamp(joints);
    Vector6 error = error_at(joints);
    KDL::Jacobian jacobian(static_cast<unsigned>(count));
    double damping = 1e-3;
    for (int i = 0; i < options_.max_iterations && !done(error); ++i) {
      jacobian_.JntToJac(joints, jacobian);
      const Eigen::MatrixXd local = local_jacobian(jacobian);
      Eigen::MatrixXd normal = local.transpose() * local;
      normal.diagonal().array() += damping;
      KDL::JntArray tried = joints;
      tried.data += normal.ldlt().solve(local.transpose() * error);
      clamp(tried);
      const KDL::Frame before = frame_;
      const Vector6 left = error_at(tried);
      if (left.squaredNorm() < error.squaredNorm()) {
        joints = tried;
        error = left;
        damping = std::max(damping / 5.0, 1e-12);
      } else {
        frame_ = before;
        damping *= 4.0;
        if (damping > 1e4) {
          break;
        }
      }
    }
    if (!done(error)) {
      return std::nullopt;
    }
    return Joints(joints.data.begin(), joints.data.end());
  }

 private:
  void clamp(KDL::JntArray& joints) const {
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      double& value = joints.data[static_cast<Eigen::Index>(i)];
      value = std::clamp(value, ranges_[i].min, ranges_[i].max);
    }
  }
  // What is missing to the target, in the sensor's frame, rotations in metres.
  Vector6 error_at(const KDL::JntArray& joints) {
    forward_.JntToCart(joints, frame_);
    const Pose now = pose_of(frame_);
    const Pose now_from_target = now.inverse() * target_;
    Vector6 error;
    error.head<3>() = now_from_target.translation();
    if (options_.free_roll) {
      error.tail<3>() = kMetresPerRadian * turn_of_axis(optical_axis(now_from_target));
    } else {
      const Eigen::AngleAxisd turn(now_from_target.linear());
      error.tail<3>() = kMetresPerRadian * turn.angle() * turn.axis();
    }
    return error;
  }
  [[nodiscard]] Eigen::MatrixXd local_jacobian(const KDL::Jacobian& jacobian) const {
    const Eigen::Matrix3d sensor_from_base = pose_of(frame_).linear().transpose();
    Eigen::MatrixXd local(6, jacobian.data.cols());
    local.topRows<3>() = sensor_from_base * jacobian.data.topRows<3>();
    local.bottomRows<3>() = kMetresPerRadian * sensor_from_base * jacobian.data.bottomRows<3>();
    if (options_.free_roll) {
      local.row(5).setZero();
    }
    return local;
  }
  [[nodiscard]] bool done(const Vector6& error) const {
    return error.head<3>().norm() <= options_.tolerance_m &&
           error.tail<3>().norm() <= kMetresPerRadian * options_.tolerance_rad;
  }

  const std::vector<JointRange>& ranges_;
  Pose target_;
  InverseOptions options_;
  KDL::ChainFkSolverPos_recursive forward_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::Frame frame_;  // of the sensor at the joints last accepted
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
  KDL::JntArray start(static_cast<unsigned>(guess.size()));
  std::copy(guess.begin(), guess.end(), start.data.begin());
  return Search(parts_->chain, parts_->ranges, base_from_sensor, options).from(start);
}

}  // namespace vantage
