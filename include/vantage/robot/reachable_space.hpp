// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/brick_grid.hpp>
#include <vantage/robot/admitted_cells.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The cells to whose centres a platform can bring the sensor from where it is now: admitted cells joined face to
/// face with the cell it starts from. Ground for every planner's decision: a robot plans in this space and in no
/// other.
class ReachableSpace {
 public:
  /// Nothing.
  ReachableSpace() = default;
  /// Floods from the cell of `current`. If the platform does not admit that cell's centre (the body stands off
  /// centre, or a new scan finds a place too tight), the flood starts from the nearest admitted cell that it may
  /// still move to, at most half a body and a cell away per axis; if there is none, but the platform admits the pose
  /// itself, that cell is all there is: the sensor may turn there.
  ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current);
  /// These cells, at least one, as if the platform stood in the first; for asking what could be done from there.
  ReachableSpace(const VoxelFrame& frame, const std::vector<VoxelIndex>& cells);
  /// The same, from the cells that are known to be admitted: AdmittedCells that have followed `map` for `platform`.
  ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current,
                 const AdmittedCells& admitted);

  /// The cell the flood started from; none if the platform cannot move at all: then nothing is reachable.
  [[nodiscard]] const std::optional<VoxelIndex>& start() const { return start_; }
  /// Whether the platform can only turn where it stands.
  [[nodiscard]] bool only_turns() const { return stands_at_m_.has_value(); }
  /// Where the sensor is when it is in a reachable cell: the cell's centre, but where it can only turn the place
  /// where it stands.
  [[nodiscard]] Eigen::Vector3d position_in(const VoxelIndex& cell) const {
    return stands_at_m_ ? *stands_at_m_ : frame_.centre_of(cell);
  }
  /// Whether the sensor can be brought to this cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return number_[cell] != kOutside; }
  /// The reachable cells in the order of their number: breadth first from the start.
  [[nodiscard]] const std::vector<VoxelIndex>& cells() const { return cells_; }
  /// How many cells it holds.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// Position of a cell in `cells()`, or kOutside.
  [[nodiscard]] std::uint32_t number_of(const VoxelIndex& cell) const { return number_[cell]; }
  /// The same, for one cell after the other; quicker where they are neighbours.
  [[nodiscard]] BrickGrid<std::uint32_t>::Reader numbers() const { return BrickGrid<std::uint32_t>::Reader(number_); }
  /// Whether a cell of a brick is reachable.
  [[nodiscard]] bool reaches(const VoxelIndex& brick) const {
    const BrickDirectory::Number number = number_.number_of(brick);
    return number != BrickDirectory::kNone && planes_[number] != BrickPlane{};
  }
  /// Whether a cell of a box is reachable.
  [[nodiscard]] bool any_in(const VoxelBox& cells) const;
  /// Calls `visit(brick address, const BrickPlane&)` for the reachable cells of every brick that holds one.
  template <class Visit>
  void for_each_brick(Visit&& visit) const {
    for (std::size_t number = 0; number < planes_.size(); ++number) {
      if (planes_[number] != BrickPlane{}) {
        visit(number_.address(number), planes_[number]);
      }
    }
  }

  /// What is not reachable.
  static constexpr std::uint32_t kOutside = 0xFFFFFFFFU;

 private:
  void flood(const AdmittedCells& admitted);
  void take(const VoxelIndex& cell);

  VoxelFrame frame_;
  std::optional<VoxelIndex> start_;
  std::optional<Eigen::Vector3d> stands_at_m_;  // where it can only turn
  std::vector<VoxelIndex> cells_;
  BrickGrid<std::uint32_t> number_{kOutside};
  std::vector<BrickPlane> planes_;  // of the cells, by the numbers of the bricks
};

}  // namespace vantage
