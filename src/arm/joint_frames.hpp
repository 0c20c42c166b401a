// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <kdl/chain.hpp>
#include <span>
#include <vantage/arm/kinematic_chain.hpp>
#include <vector>

namespace vantage {

// A kinematic chain in which all fixed transforms between movable joints are multiplied once. Each joint has a frame,
// and it rotates about or slides along its z axis. The results equal those of KDL and need a fraction of the time.
class JointFrames {
 public:
  // A rigid transform to the parent frame or to the base.
  struct Frame {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Eigen::Vector3d place = Eigen::Vector3d::Zero();

    [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return turn * point + place; }
    [[nodiscard]] Frame operator*(const Frame& next) const { return {turn * next.turn, turn * next.place + place}; }
  };

  JointFrames() = default;
  JointFrames(const KDL::Chain& chain, std::span<const Capsule> capsules, std::span<const std::size_t> joints_before);

  [[nodiscard]] std::size_t size() const { return joints_.size(); }
  [[nodiscard]] bool slides(std::size_t joint) const { return joints_[joint].slides; }
  // Calls `visit(0, frame)` for the base and then `visit(i + 1, frame)` for each joint i from the base outwards, with
  // its moved frame in the frame of the base.
  template <class Visit>
  void follow(std::span<const double> joints, Visit&& visit) const {
    Frame frame;
    visit(std::size_t{0}, frame);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      frame = frame * joints_[i].from_last;
      if (joints_[i].slides) {
        frame.place += joints[i] * frame.turn.col(2);
      } else {
        const double cosine = std::cos(joints[i]);
        const double sine = std::sin(joints[i]);
        const Eigen::Vector3d x = frame.turn.col(0);
        const Eigen::Vector3d y = frame.turn.col(1);
        frame.turn.col(0) = cosine * x + sine * y;
        frame.turn.col(1) = cosine * y - sine * x;
      }
      visit(i + 1, frame);
    }
  }
  // The pose of the sensor, given the frame of the last joint.
  [[nodiscard]] Frame sensor(const Frame& last) const { return last * from_sensor_; }
  // The capsules in the frame of the base.
  [[nodiscard]] std::vector<Capsule> body_at(std::span<const double> joints) const;

 private:
  struct Joint {
    Frame from_last;  // frame of the joint at value 0, in the frame of the previous joint
    bool slides = false;
  };
  std::vector<Joint> joints_;
  Frame from_sensor_;
  std::vector<Capsule> pieces_;  // in the frame of the joint that moves them, sorted from the base outwards
  std::vector<std::size_t> place_in_capsules_;  // original index of each piece
  std::vector<std::size_t> pieces_up_to_;       // number of pieces moved by the base and the joints up to each one
};

}  // namespace vantage
