// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/map/impl/ray_block.hpp>

namespace vantage::detail {

/// Bit mask of the rays with this value.
[[nodiscard]] std::uint64_t equal_to(const RayBlock::PerRay<std::int32_t>& values, std::int32_t value,
                                     InstructionSet set);

/// Bit mask of the rays whose value differs from that of the ray before. The first ray always counts.
[[nodiscard]] std::uint64_t changes_of(const RayBlock::PerRay<std::int32_t>& values, InstructionSet set);

/// The smallest and the largest value of the `active` rays.
[[nodiscard]] std::pair<double, double> range_of(const RayBlock::PerRay<double>& values, std::uint64_t active,
                                                 InstructionSet set);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/lane_queries.ipp>
#endif
