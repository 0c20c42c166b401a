// SPDX-License-Identifier: MIT
#pragma once

#include <kdl/chain.hpp>
#include <string>
#include <utility>
#include <vantage/arm/kinematic_chain.hpp>
#include <vector>

#include "arm/joint_frames.hpp"

namespace vantage {

struct KinematicChain::Parts {
  KDL::Chain chain;  // one segment per link except the base; its frame is that of the link
  std::vector<JointRange> ranges;
  std::vector<std::string> names;
  std::vector<Capsule> capsules;
  std::vector<std::size_t> joints_before{0};  // per link
  double reach_m = 0.0;
  JointFrames frames;
  // pairs of capsules with at least two joints between them
  std::vector<std::pair<std::size_t, std::size_t>> may_touch;

  void add(const KDL::Segment& segment) {
    chain.addSegment(segment);
    joints_before.push_back(chain.getNrOfJoints());
  }
};

[[nodiscard]] inline Pose pose_of(const KDL::Frame& frame) {
  Pose pose = Pose::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      pose.linear()(row, column) = frame.M(row, column);
    }
    pose.translation()[row] = frame.p[row];
  }
  return pose;
}

[[nodiscard]] inline KDL::Frame frame_of(const Pose& pose) {
  KDL::Frame frame;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      frame.M(row, column) = pose.linear()(row, column);
    }
    frame.p[row] = pose.translation()[row];
  }
  return frame;
}

}  // namespace vantage
