// SPDX-License-Identifier: MIT
#pragma once

#include "field/block_level.hpp"
#include "field/graph_level.hpp"

namespace vantage::detail {

/// The level after the blocks: a node for each piece of 2 x 2 x 2 blocks that hangs together, so that what lies on
/// two sides of a thin wall is never one unknown. Sets `blocks.node`.
[[nodiscard]] GraphLevel graph_of_blocks(const FineLevel& fine, BlockLevel& blocks);

}  // namespace vantage::detail
