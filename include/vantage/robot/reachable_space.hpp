// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/robot/admitted_cells.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace vantage::detail {
class ConnectedCells;
}

namespace VANTAGE_EXPORT vantage {

/// The cells to whose centres a platform can bring the sensor from its current pose: admitted cells that are
/// connected with the start cell through faces. Planners plan in this space only.
///
///     ReachableSpace space;
///     map.insert(scan);
///     space.follow(map, platform, pose);  // the cost follows what the scan changed
///
/// The content depends only on the map, the platform and the pose, not on earlier calls. Movable, not copyable.
class ReachableSpace {
 public:
  /// An empty space.
  ReachableSpace();
  /// The space of one map; `follow` as its only call.
  ReachableSpace(const OccupancyMap& map, const Platform& platform, const Pose& current);
  /// A space of these cells, at least one; the first one is the start. For hypothetical queries.
  ReachableSpace(const VoxelFrame& frame, const std::vector<VoxelIndex>& cells);
  /// Not copyable.
  ReachableSpace(const ReachableSpace&) = delete;
  /// Not copyable.
  ReachableSpace& operator=(const ReachableSpace&) = delete;
  /// Moves the content.
  ReachableSpace(ReachableSpace&& other) noexcept;
  /// Moves the content.
  ReachableSpace& operator=(ReachableSpace&& other) noexcept;
  ~ReachableSpace();

  /// Updates the space for the sensor at `current` (world_from_sensor). It starts in the cell of `current`. If the
  /// platform does not admit that cell's centre, e.g. because the body stands off centre or a scan found the place
  /// too narrow, it starts in the nearest admitted cell to which the platform can move, within half the body plus one
  /// cell per axis (at least 2, at most 16 cells). If there is none and the platform admits the pose itself, the
  /// space is that cell, and the sensor can only turn there.
  void follow(const OccupancyMap& map, const Platform& platform, const Pose& current);

  /// The cell in which the space starts. None if the platform cannot move at all; then nothing is reachable.
  [[nodiscard]] const std::optional<VoxelIndex>& start() const { return start_; }
  /// Whether the platform can only turn where it is.
  [[nodiscard]] bool only_turns() const { return stands_at_m_.has_value(); }
  /// The position of the sensor in a reachable cell, metres, world: the cell's centre or, if `only_turns()`, the
  /// current position.
  [[nodiscard]] Eigen::Vector3d position_in(const VoxelIndex& cell) const {
    return stands_at_m_ ? *stands_at_m_ : frame_.centre_of(cell);
  }
  /// Whether the sensor can be brought to this cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return cells_.contains(cell); }
  /// Number of cells.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The reachable cells, ordered by brick (raster order of their addresses), then by their offset in the brick.
  [[nodiscard]] std::vector<VoxelIndex> cells() const;
  /// The cell at this position of `cells()`, without making the list. `position` must be less than `size()`.
  [[nodiscard]] VoxelIndex cell(std::size_t position) const;
  /// The reachable cells of a brick, or null if it never had any. Valid until the next `follow`.
  [[nodiscard]] const BrickPlane* find(const VoxelIndex& brick) const { return cells_.find(brick); }
  /// Whether a cell of this box is reachable.
  [[nodiscard]] bool any_in(const VoxelBox& cells) const;
  /// Calls `visit(brick address, const BrickPlane&)` for each brick with a reachable cell, in raster order.
  template <class Visit>
  void for_each_brick(Visit&& visit) const {
    for (const Stored& brick : bricks_) {
      visit(brick.address, *cells_.find(brick.address));
    }
  }

  /// The cells that the platform admits in the map of the last `follow`, reachable or not.
  [[nodiscard]] const AdmittedCells& admitted() const { return admitted_; }
  /// Whether the last `follow` started anew, because the map or the platform is another one.
  [[nodiscard]] bool started_anew() const { return started_anew_; }
  /// The bricks whose reachable cells the last `follow` has changed, in raster order.
  [[nodiscard]] const std::vector<VoxelIndex>& changed() const { return changed_; }

 private:
  struct Stored {
    VoxelIndex address;
    std::size_t count;  // reachable cells
    std::size_t first;  // position in cells() of the first one
  };
  void assign(const VoxelIndex& brick, const BrickPlane& cells);
  void count();

  VoxelFrame frame_;
  std::optional<VoxelIndex> start_;
  std::optional<Eigen::Vector3d> stands_at_m_;  // set if it can only turn
  AdmittedCells admitted_;
  std::unique_ptr<detail::ConnectedCells> connected_;
  BrickSet cells_;
  std::vector<Stored> bricks_;  // with a reachable cell, in raster order
  std::size_t size_ = 0;
  std::vector<VoxelIndex> changed_;
  bool started_anew_ = true;
  bool is_another_ = false;  // another map or platform since the last complete follow
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/reachable_space.ipp>
#endif
