// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/block_level.hpp>
#include <vantage/field/impl/graph_level.hpp>

namespace vantage::detail {

/// Builds the level after the blocks. Each connected piece of 2 x 2 x 2 blocks becomes one node, so the two sides of
/// a thin wall never share an unknown. Sets `blocks.node`.
[[nodiscard]] GraphLevel graph_of_blocks(const FineLevel& fine, BlockLevel& blocks);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/block_graph.ipp>
#endif
