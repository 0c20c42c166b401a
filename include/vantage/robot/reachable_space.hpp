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

/// The cells to whose centres a platform can bring the sensor from its current pose: admitted cells that are
/// connected with the start cell through faces. Planners plan in this space only.
class ReachableSpace {
 public:
  /// An empty space.
  ReachableSpace() = default;
  /// Flood fill from the cell of `current` (world_from_sensor). If the platform does not admit that cell's centre,
  /// e.g. because the body stands off centre or a scan found the place too narrow, the fill starts at the nearest
  /// admitted cell to which it can move, within half the body plus one cell per axis (at least 2, at most 16 cells).
  /// If there is none and the platform admits the pose itself, the space is that cell, and the sensor can only turn
  /// there.
  ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current);
  /// A space of these cells, at least one; the first one is the start. For hypothetical queries.
  ReachableSpace(const VoxelFrame& frame, const std::vector<VoxelIndex>& cells);
  /// As the first constructor, with the admitted cells given: `admitted` must have followed `map` for `platform`.
  ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current,
                 const AdmittedCells& admitted);

  /// The cell in which the fill started. None if the platform cannot move at all; then nothing is reachable.
  [[nodiscard]] const std::optional<VoxelIndex>& start() const { return start_; }
  /// Whether the platform can only turn where it is.
  [[nodiscard]] bool only_turns() const { return stands_at_m_.has_value(); }
  /// The position of the sensor in a reachable cell, metres, world: the cell's centre or, if `only_turns()`, the
  /// current position.
  [[nodiscard]] Eigen::Vector3d position_in(const VoxelIndex& cell) const {
    return stands_at_m_ ? *stands_at_m_ : frame_.centre_of(cell);
  }
  /// Whether the sensor can be brought to this cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return number_[cell] != kOutside; }
  /// The reachable cells by number, in breadth-first order from the start.
  [[nodiscard]] const std::vector<VoxelIndex>& cells() const { return cells_; }
  /// Number of cells.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// Index of a cell in `cells()`, or kOutside.
  [[nodiscard]] std::uint32_t number_of(const VoxelIndex& cell) const { return number_[cell]; }
  /// A reader for many calls of `number_of`; fast for neighbouring cells.
  [[nodiscard]] BrickGrid<std::uint32_t>::Reader numbers() const { return BrickGrid<std::uint32_t>::Reader(number_); }
  /// Whether a cell of this brick is reachable.
  [[nodiscard]] bool reaches(const VoxelIndex& brick) const {
    const BrickDirectory::Number number = number_.number_of(brick);
    return number != BrickDirectory::kNone && planes_[number] != BrickPlane{};
  }
  /// Whether a cell of this box is reachable.
  [[nodiscard]] bool any_in(const VoxelBox& cells) const;
  /// Calls `visit(brick address, const BrickPlane&)` for each brick with a reachable cell.
  template <class Visit>
  void for_each_brick(Visit&& visit) const {
    for (std::size_t number = 0; number < planes_.size(); ++number) {
      if (planes_[number] != BrickPlane{}) {
        visit(number_.address(number), planes_[number]);
      }
    }
  }

  /// The number of a cell that is not reachable.
  static constexpr std::uint32_t kOutside = 0xFFFFFFFFU;

 private:
  void flood(const AdmittedCells& admitted);
  void take(const VoxelIndex& cell);

  VoxelFrame frame_;
  std::optional<VoxelIndex> start_;
  std::optional<Eigen::Vector3d> stands_at_m_;  // set if it can only turn
  std::vector<VoxelIndex> cells_;
  BrickGrid<std::uint32_t> number_{kOutside};
  std::vector<BrickPlane> planes_;  // reachable cells by number of the brick
};

}  // namespace vantage
