// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vantage/arm/kinematic_chain.hpp>
#include <vector>

namespace vantage {

// The joint space of a path search: ranges and collision tests.
struct JointSpace {
  std::vector<JointRange> ranges;
  std::function<bool(const Joints&)> admits;
  std::function<bool(const Joints& from, const Joints& to)> admits_motion;
};

// RRT-Connect from OMPL: returns a path from one configuration to the other, both included; both must be admitted.
// nullopt if none is found within `iterations`. Deterministic for equal seeds. (Kuffner & LaValle 2000.)
[[nodiscard]] std::optional<std::vector<Joints>> rrt_connect(const JointSpace& space, const Joints& from,
                                                             const Joints& to, std::size_t iterations,
                                                             std::uint64_t seed);

}  // namespace vantage
