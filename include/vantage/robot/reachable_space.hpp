// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The cells to whose centres a platform can bring the sensor from where it is now: admitted cells joined face to
/// face with the cell it starts from. Ground for every planner's decision: a robot plans in this space and in no
/// other.
class ReachableSpace {
 public:
  /// Floods from the cell of `current`. If the platform does not admit that cell (a new scan may find a place too
  /// tight), the flood starts from the nearest admitted cell that it may still move to, at most two cells away.
  ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current);

  /// The cell the flood started from; none if the platform cannot move at all: then nothing is reachable.
  [[nodiscard]] const std::optional<VoxelIndex>& start() const { return start_; }
  /// Whether the sensor can be brought to this cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return number_.value_or(cell, kOutside) != kOutside; }
  /// The reachable cells in the order of their number: breadth first from the start.
  [[nodiscard]] const std::vector<VoxelIndex>& cells() const { return cells_; }
  /// How many cells it holds.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// Position of a cell in `cells()`, or kOutside.
  [[nodiscard]] std::uint32_t number_of(const VoxelIndex& cell) const { return number_.value_or(cell, kOutside); }

  /// What is not reachable.
  static constexpr std::uint32_t kOutside = 0xFFFFFFFFU;

 private:
  std::optional<VoxelIndex> start_;
  std::vector<VoxelIndex> cells_;
  VoxelGrid<std::uint32_t> number_;
};

}  // namespace vantage
