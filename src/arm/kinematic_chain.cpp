// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <stdexcept>
#include <utility>
#include <vantage/arm/kinematic_chain.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "arm/chain_parts.hpp"
#include "arm/segment_distance.hpp"

namespace vantage {
namespace {

void require_count(std::span<const double> joints, std::size_t count) {
  if (joints.size() != count) {
    throw std::invalid_argument("KinematicChain: " + std::to_string(joints.size()) + " values for " +
                                std::to_string(count) + " joints");
  }
}

KDL::JntArray array_of(std::span<const double> joints, std::size_t count) {
  require_count(joints, count);
  KDL::JntArray array(static_cast<unsigned>(count));
  std::copy(joints.begin(), joints.end(), array.data.begin());
  return array;
}

// How much a segment adds to the largest possible distance from the base.
double length_of(const KDL::Segment& segment, const JointRange* range) {
  const double slide_m =
      segment.getJoint().getType() == KDL::Joint::TransAxis || segment.getJoint().getType() == KDL::Joint::TransZ
          ? std::max(std::abs(range->min), std::abs(range->max))
          : 0.0;
  return segment.getFrameToTip().p.Norm() + slide_m;
}

void check(const DhRow& row) {
  const auto require_finite = [](double value, const char* field) {
    detail::require_option(std::isfinite(value), field, value, "finite");
  };
  require_finite(row.a_m, "DhRow::a_m");
  require_finite(row.alpha_rad, "DhRow::alpha_rad");
  require_finite(row.d_m, "DhRow::d_m");
  require_finite(row.theta_rad, "DhRow::theta_rad");
}

}  // namespace

// Computes all derived data.
void KinematicChain::finish(Parts& parts) {
  for (const JointRange& range : parts.ranges) {
    detail::require_option(std::isfinite(range.min) && std::isfinite(range.max) && range.min <= range.max,
                           "JointRange::min", range.min, "finite and <= max");
  }
  std::vector<double> furthest_m{0.0};  // largest distance of each link frame from the base
  std::size_t joint = 0;
  for (const KDL::Segment& segment : parts.chain.segments) {
    const bool moves = segment.getJoint().getType() != KDL::Joint::None;
    furthest_m.push_back(furthest_m.back() + length_of(segment, moves ? &parts.ranges[joint] : nullptr));
    joint += moves ? 1U : 0U;
  }
  parts.reach_m = furthest_m.back();
  for (const Capsule& capsule : parts.capsules) {
    if (capsule.link >= furthest_m.size()) {
      throw std::invalid_argument("Capsule::link is " + std::to_string(capsule.link) + ", must be < " +
                                  std::to_string(furthest_m.size()));
    }
    detail::require_option(std::isfinite(capsule.radius_m) && capsule.radius_m > 0.0, "Capsule::radius_m",
                           capsule.radius_m, "> 0");
    for (int axis = 0; axis < 3; ++axis) {
      detail::require_option(std::isfinite(capsule.from_m[axis]), "Capsule::from_m", capsule.from_m[axis], "finite");
      detail::require_option(std::isfinite(capsule.to_m[axis]), "Capsule::to_m", capsule.to_m[axis], "finite");
    }
    const double out_m = std::max(capsule.from_m.norm(), capsule.to_m.norm()) + capsule.radius_m;
    parts.reach_m = std::max(parts.reach_m, furthest_m[capsule.link] + out_m);
  }
  parts.frames = JointFrames(parts.chain, parts.capsules, parts.joints_before);
  for (std::size_t i = 0; i < parts.capsules.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t a = parts.joints_before[parts.capsules[i].link];
      const std::size_t b = parts.joints_before[parts.capsules[j].link];
      if (std::max(a, b) - std::min(a, b) >= 2) {
        parts.may_touch.emplace_back(i, j);
      }
    }
  }
}

KinematicChain KinematicChain::from_dh(std::span<const DhRow> rows, const Pose& last_from_sensor,
                                       std::vector<Capsule> capsules) {
  if (rows.empty()) {
    throw std::invalid_argument("KinematicChain::from_dh needs at least one row");
  }
  if (!is_rigid(last_from_sensor)) {
    throw std::invalid_argument("KinematicChain::from_dh: last_from_sensor is not a rigid transform");
  }
  const auto parts = std::make_shared<Parts>();
  for (const DhRow& row : rows) {
    check(row);
    const std::string name = "joint_" + std::to_string(parts->names.size() + 1);
    const KDL::Joint joint(name, row.slides ? KDL::Joint::TransZ : KDL::Joint::RotZ);
    parts->add(KDL::Segment(name, joint, KDL::Frame::DH(row.a_m, row.alpha_rad, row.d_m, row.theta_rad)));
    parts->ranges.push_back(row.range);
    parts->names.push_back(name);
  }
  parts->add(KDL::Segment("sensor", KDL::Joint("fixed", KDL::Joint::None), frame_of(last_from_sensor)));
  parts->capsules = std::move(capsules);
  finish(*parts);
  return KinematicChain(parts);
}

std::size_t KinematicChain::joint_count() const { return parts_->ranges.size(); }
const std::vector<JointRange>& KinematicChain::ranges() const { return parts_->ranges; }
const std::vector<std::string>& KinematicChain::joint_names() const { return parts_->names; }
const std::vector<Capsule>& KinematicChain::capsules() const { return parts_->capsules; }
std::size_t KinematicChain::joints_before(std::size_t link) const { return parts_->joints_before.at(link); }
double KinematicChain::reach_m() const { return parts_->reach_m; }

bool KinematicChain::in_range(std::span<const double> joints) const {
  return std::equal(joints.begin(), joints.end(), ranges().begin(), ranges().end(),
                    [](double value, const JointRange& range) { return value >= range.min && value <= range.max; });
}

Pose KinematicChain::sensor_pose(std::span<const double> joints) const {
  KDL::ChainFkSolverPos_recursive solver(parts_->chain);
  KDL::Frame frame;
  solver.JntToCart(array_of(joints, joint_count()), frame);
  return pose_of(frame);
}

std::vector<Pose> KinematicChain::link_poses(std::span<const double> joints) const {
  KDL::ChainFkSolverPos_recursive solver(parts_->chain);
  std::vector<KDL::Frame> frames(parts_->chain.getNrOfSegments());
  solver.JntToCart(array_of(joints, joint_count()), frames);
  std::vector<Pose> poses{Pose::Identity()};
  poses.reserve(frames.size() + 1);
  for (const KDL::Frame& frame : frames) {
    poses.push_back(pose_of(frame));
  }
  return poses;
}

std::vector<Capsule> KinematicChain::body_at(std::span<const double> joints) const {
  require_count(joints, joint_count());
  return parts_->frames.body_at(joints);
}

bool KinematicChain::touches_itself(std::span<const Pose> base_from_links) const {
  std::vector<Capsule> body = capsules();
  for (Capsule& capsule : body) {
    capsule.from_m = base_from_links[capsule.link] * capsule.from_m;
    capsule.to_m = base_from_links[capsule.link] * capsule.to_m;
  }
  return touches_itself(body);
}

bool KinematicChain::touches_itself(std::span<const Capsule> body) const {
  return std::any_of(parts_->may_touch.begin(), parts_->may_touch.end(), [&](const auto& pair) {
    const Capsule& a = body[pair.first];
    const Capsule& b = body[pair.second];
    return segment_distance(a.from_m, a.to_m, b.from_m, b.to_m) < a.radius_m + b.radius_m;
  });
}

}  // namespace vantage
