// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vantage/report/recorded_cycle.hpp>

namespace vantage::detail {

/// The cells of all bricks after the last cycle; the next cycle is encoded as the difference.
using BrickStates = std::unordered_map<VoxelIndex, BrickState>;

/// Encodes a cycle. Bricks are written as their difference from `before`, which is then brought up to date.
[[nodiscard]] std::string encode(const RecordedCycle& cycle, BrickStates& before);
/// Decodes a cycle and brings `before` up to date. Throws std::runtime_error if the bytes are not a cycle;
/// `before` must then not be used any more.
[[nodiscard]] RecordedCycle decode(std::string_view bytes, BrickStates& before);

}  // namespace vantage::detail
