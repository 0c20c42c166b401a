// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/arm/kinematic_chain.hpp>

namespace vantage::test {

/// The chain of the arm that the examples carry.
inline KinematicChain tracked_arm() {
  return KinematicChain::from_urdf(std::filesystem::path(VANTAGE_EXAMPLES) / "tracked_arm.urdf", "base_link",
                                   "sensor");
}

}  // namespace vantage::test
