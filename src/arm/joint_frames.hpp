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

// A chain with all that is fixed between two joints that move multiplied out once: each has a frame of its own, whose
// z axis it turns about or slides along. Says the same as KDL, in a fraction of the time.
class JointFrames {
 public:
  // Of something, in the frame it is fixed to or in the base's.
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
  // Calls `visit(i, frame)` for the base, i = 0, and then for every joint from the base outwards, moved so far.
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
  // Where the sensor is, by the frame of the last joint.
  [[nodiscard]] Frame sensor(const Frame& last) const { return last * from_sensor_; }
  // The body at these joints, in the base's frame.
  [[nodiscard]] std::vector<Capsule> body_at(std::span<const double> joints) const;

 private:
  struct Joint {
    Frame from_last;  // its frame while it is at 0, in that of the joint before
    bool slides = false;
  };
  std::vector<Joint> joints_;
  Frame from_sensor_;
  std::vector<Capsule> pieces_;                 // in the frame of the joint that moves them, innermost first
  std::vector<std::size_t> place_in_capsules_;  // of each
  std::vector<std::size_t> pieces_up_to_;       // how many of them the base and the joints so far move
};

}  // namespace vantage
