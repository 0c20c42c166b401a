// SPDX-License-Identifier: MIT
#include "arm/joint_frames.hpp"

#include <Eigen/Geometry>

namespace vantage {
namespace {

Eigen::Vector3d vector_of(const KDL::Vector& vector) { return {vector.x(), vector.y(), vector.z()}; }

JointFrames::Frame joint_frame_of(const KDL::Frame& frame) {
  JointFrames::Frame out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out.turn(row, column) = frame.M(row, column);
    }
  }
  out.place = vector_of(frame.p);
  return out;
}

bool is_sliding(const KDL::Joint& joint) {
  switch (joint.getType()) {
    case KDL::Joint::TransAxis:
    case KDL::Joint::TransX:
    case KDL::Joint::TransY:
    case KDL::Joint::TransZ:
      return true;
    default:
      return false;
  }
}

}  // namespace

JointFrames::JointFrames(const KDL::Chain& chain, std::span<const Capsule> capsules,
                         std::span<const std::size_t> joints_before) {
  std::vector<Frame> links{{}};  // pose of each link in the frame of the last joint that moves it
  for (const KDL::Segment& segment : chain.segments) {
    const KDL::Joint& joint = segment.getJoint();
    const Frame segment_at_0 = joint_frame_of(segment.pose(0.0));
    if (joint.getType() == KDL::Joint::None) {
      links.push_back(links.back() * segment_at_0);
      continue;
    }
    Frame moved = joint_frame_of(joint.pose(0.0));
    moved.turn *=
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), vector_of(joint.JointAxis())).toRotationMatrix();
    joints_.push_back({links.back() * moved, is_sliding(joint)});
    const Frame to_moved{moved.turn.transpose(), -(moved.turn.transpose() * moved.place)};
    links.push_back(to_moved * segment_at_0);
  }
  from_sensor_ = links.back();
  for (std::size_t joint = 0; joint <= joints_.size(); ++joint) {
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      if (joints_before[capsules[i].link] == joint) {
        Capsule piece = capsules[i];
        piece.from_m = links[piece.link] * piece.from_m;
        piece.to_m = links[piece.link] * piece.to_m;
        pieces_.push_back(piece);
        place_in_capsules_.push_back(i);
      }
    }
    pieces_up_to_.push_back(pieces_.size());
  }
}

std::vector<Capsule> JointFrames::body_at(std::span<const double> joints) const {
  std::vector<Capsule> body(pieces_.size());
  std::size_t next = 0;
  follow(joints, [&](std::size_t joint, const Frame& frame) {
    for (; next < pieces_up_to_[joint]; ++next) {
      const Capsule& piece = pieces_[next];
      body[place_in_capsules_[next]] = {piece.link, frame * piece.from_m, frame * piece.to_m, piece.radius_m};
    }
  });
  return body;
}

}  // namespace vantage
