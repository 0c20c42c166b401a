// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <random>
#include <vantage/arm/kinematic_chain.hpp>

namespace vantage::test {

/// The kinematic chain of examples/tracked_arm.urdf.
inline KinematicChain tracked_arm() {
  return KinematicChain::from_urdf(std::filesystem::path(VANTAGE_EXAMPLES) / "tracked_arm.urdf", "base_link",
                                   "sensor");
}

/// Random values of all joints, each within its range.
inline Joints random_joints(const KinematicChain& chain, std::mt19937_64& engine) {
  Joints joints;
  for (const JointRange& range : chain.ranges()) {
    joints.push_back(std::uniform_real_distribution<double>(range.min, range.max)(engine));
  }
  return joints;
}

}  // namespace vantage::test
