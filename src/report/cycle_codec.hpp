// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vantage/report/recorded_cycle.hpp>

namespace vantage::detail {

/// The cells of all bricks after the last cycle, which the next one is told against.
using BrickStates = std::unordered_map<VoxelIndex, BrickState>;

/// One cycle as bytes. Of bricks only what differs from `before` is told, and `before` follows.
[[nodiscard]] std::string encode(const RecordedCycle& cycle, BrickStates& before);
/// The inverse. Throws std::runtime_error if the bytes are not those of a cycle; `before` is then of no more use.
[[nodiscard]] RecordedCycle decode(std::string_view bytes, BrickStates& before);

}  // namespace vantage::detail
