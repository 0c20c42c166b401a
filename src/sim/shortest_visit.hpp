// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

namespace vantage {

/// A way over the cells of a ReachableSpace.
struct Visit {
  std::vector<std::uint32_t> cells;  // by number, from the start on
  double length = 0.0;               // in cells
};

/// A step to a cell near by, and how far that is, in cells.
struct WideStep {
  VoxelIndex by;
  float length;
};

/// All steps of up to two cells along each axis that are no multiple of a shorter one: 98.
[[nodiscard]] const std::vector<WideStep>& wide_steps();

/// Distance from each cell of the space to the nearest of `from`, over wide steps, in cells.
[[nodiscard]] std::vector<float> distances_from(const ReachableSpace& space, std::span<const std::uint32_t> from);

/// The shortest way from the start of the space, over wide steps, that comes into each of `sets` sets of cells in
/// whatever order; bit i of `member[c]` says whether cell c is in set i. Exact: Dijkstra over the cells and what has
/// been visited before. Empty if a set cannot be reached. Costs 4 bytes for each cell and each of 2^sets.
[[nodiscard]] Visit shortest_visit(const ReachableSpace& space, std::span<const std::uint16_t> member,
                                   std::size_t sets);

}  // namespace vantage
