// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vantage/arm/kinematic_chain.hpp>
#include <vector>

namespace vantage {

// What a search for a way of the joints asks about the world.
struct JointSpace {
  std::vector<JointRange> ranges;
  std::function<bool(const Joints&)> admits;
  std::function<bool(const Joints& from, const Joints& to)> admits_motion;
};

// RRT-Connect (Kuffner & LaValle 2000) as OMPL has it: a way of joints from one configuration to the other, both
// included and both admitted; none if it was not found in so many iterations. The seed decides.
[[nodiscard]] std::optional<std::vector<Joints>> rrt_connect(const JointSpace& space, const Joints& from,
                                                             const Joints& to, std::size_t iterations,
                                                             std::uint64_t seed);

}  // namespace vantage
