// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/numbered_cells.hpp"

namespace vantage {

/// A path over the cells of a ReachableSpace.
struct Visit {
  std::vector<std::uint32_t> cells;  // numbers of the cells, from the start
  double length = 0.0;               // in cells
};

/// A step to a nearby cell and its length in cells.
struct WideStep {
  VoxelIndex by;
  float length;
};

/// All steps of up to two cells along each axis that are not a multiple of a shorter one: 98.
[[nodiscard]] const std::vector<WideStep>& wide_steps();

/// The wide steps between the cells of a space. Memory: 8 bytes per step, in the open 98 per cell, in a plane 16.
class StepGraph {
 public:
  /// A step to a cell, with its length in cells.
  struct Step {
    std::uint32_t to;
    float length;
  };
  explicit StepGraph(const NumberedCells& space);

  /// The number of cells.
  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
  /// The steps from a cell.
  [[nodiscard]] std::span<const Step> steps(std::size_t cell) const {
    return {steps_.data() + first_[cell], steps_.data() + first_[cell + 1]};
  }

 private:
  std::vector<std::size_t> first_;  // by cell, and one more for the end
  std::vector<Step> steps_;
};

/// Distance in cells from each cell of the space to the nearest of `from`, over wide steps.
[[nodiscard]] std::vector<float> distances_from(const StepGraph& graph, std::span<const std::uint32_t> from);

/// The shortest path over wide steps from the start of the space that enters each of `sets` sets of cells, in any
/// order. Bit i of `member[c]` says whether cell c is in set i. Exact: Dijkstra over cells and visited sets. Empty
/// if a set cannot be reached. Memory: 4 bytes per cell and per combination of sets (2^sets).
[[nodiscard]] Visit shortest_visit(const StepGraph& graph, std::span<const std::uint16_t> member, std::size_t sets);

}  // namespace vantage
