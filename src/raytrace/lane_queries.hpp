// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map/instruction_set.hpp>
#include <map/ray_block.hpp>
#include <utility>

namespace vantage {

/// The rays with this value, a bit for each.
[[nodiscard]] std::uint64_t equal_to(const RayBlock::PerRay<std::int32_t>& values, std::int32_t value,
                                     InstructionSet set);

/// The rays with another value than the ray before them, a bit for each; the first is one.
[[nodiscard]] std::uint64_t changes_of(const RayBlock::PerRay<std::int32_t>& values, InstructionSet set);

/// The least and the largest of the values of the `active` rays.
[[nodiscard]] std::pair<double, double> range_of(const RayBlock::PerRay<double>& values, std::uint64_t active,
                                                 InstructionSet set);

}  // namespace vantage
