// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The goals of a search that are about as near as the nearest one.
struct NearGoals {
  std::vector<VoxelIndex> goals;  ///< without duplicates, nearest first
  /// The cells that the search has met: those with a path that is at most `detour_m` longer than that to the nearest
  /// goal, and their neighbours.
  BrickSet met;
};

/// Shortest paths through the cells of a ReachableSpace. A step leads to one of the 26 neighbours and cuts no corner:
/// all cells of the 1 x 2 x 2 or 2 x 2 x 2 block that it crosses must be reachable. Ties are broken by the order in
/// which the search meets the cells, so the result is deterministic.
class GridPaths {
 public:
  /// Paths from the start of `space`, which must outlive this object.
  explicit GridPaths(const ReachableSpace& space) : space_(space), start_(space.start()) {}
  /// Paths from a reachable cell of `space`.
  GridPaths(const ReachableSpace& space, const VoxelIndex& start) : space_(space), start_(start) {}

  /// The path to the nearest of `goals`, both ends included (Dijkstra). Empty if no goal is reachable.
  [[nodiscard]] std::vector<VoxelIndex> to_nearest(std::span<const VoxelIndex> goals) const;
  /// The goals whose path is at most `detour_m` metres longer than the path to the nearest one. `cell_m` is the edge
  /// of a cell, metres. No goals if none is reachable.
  [[nodiscard]] NearGoals nearest_within(std::span<const VoxelIndex> goals, double detour_m, double cell_m) const;
  /// The path to one cell, both ends included (A*). Empty if the cell is not reachable.
  [[nodiscard]] std::vector<VoxelIndex> to(const VoxelIndex& goal) const;

 private:
  const ReachableSpace& space_;
  std::optional<VoxelIndex> start_;
};

/// Converts a path of cells to poses (world_from_sensor): from `from` through cell centres to `to`. Corners that a
/// straight admitted motion can skip are removed; in between, the sensor looks along the path, or as it does at
/// `from` where the body has no room to look along it, or from cell to cell. None if a motion between consecutive
/// poses is not admitted.
[[nodiscard]] std::optional<std::vector<Pose>> poses_along(const OccupancyMap& map, const Platform& platform,
                                                           const Pose& from, std::span<const VoxelIndex> cells,
                                                           const Pose& to);

/// The path from `from` to `to` (world_from_sensor) along the shortest path of admitted cells. None if there is none,
/// or if the platform does not admit `to`.
[[nodiscard]] std::optional<std::vector<Pose>> grid_path(const OccupancyMap& map, const Platform& platform,
                                                         const Pose& from, const Pose& to);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/grid_path.ipp>
#endif
