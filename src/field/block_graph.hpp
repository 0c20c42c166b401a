// SPDX-License-Identifier: MIT
#pragma once

#include "field/block_level.hpp"
#include "field/graph_level.hpp"

namespace vantage::detail {

/// Builds the level after the blocks. Each connected piece of 2 x 2 x 2 blocks becomes one node, so the two sides of
/// a thin wall never share an unknown. Sets `blocks.node`.
[[nodiscard]] GraphLevel graph_of_blocks(const FineLevel& fine, BlockLevel& blocks);

}  // namespace vantage::detail
