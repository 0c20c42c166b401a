// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Shortest ways over the cells of a ReachableSpace. A step goes to one of the 26 neighbours and cuts no corner:
/// every cell of the block it crosses must be reachable. Ties are settled by cell number, so the way never depends on
/// chance.
class GridPaths {
 public:
  /// Ways from the start of `space`, which must outlive it.
  explicit GridPaths(const ReachableSpace& space) : space_(space) {}

  /// Dijkstra from the start of the space until the first of `goals` is settled: the way to it, both ends included.
  /// Empty if no goal is reachable.
  [[nodiscard]] std::vector<VoxelIndex> to_nearest(std::span<const VoxelIndex> goals) const;
  /// Those of `goals` whose way is at most `detour_m` longer than the way to the nearest of them, each once, nearest
  /// first; `cell_m` is the edge of a cell. Empty if no goal is reachable.
  [[nodiscard]] std::vector<VoxelIndex> nearest_within(std::span<const VoxelIndex> goals, double detour_m,
                                                       double cell_m) const;
  /// A* from the start of the space to one cell, both ends included. Empty if the cell is not reachable.
  [[nodiscard]] std::vector<VoxelIndex> to(const VoxelIndex& goal) const;

 private:
  [[nodiscard]] std::vector<bool> marked(std::span<const VoxelIndex> goals) const;

  const ReachableSpace& space_;
};

/// Turns a way over cells into poses that the platform can follow: from `from`, through cell centres, to `to`,
/// leaving out every corner that a straight admitted motion makes needless; between the ends the sensor looks along
/// its way. None if one of the joining motions is not admitted.
[[nodiscard]] std::optional<std::vector<Pose>> poses_along(const OccupancyMap& map, const Platform& platform,
                                                           const Pose& from, std::span<const VoxelIndex> cells,
                                                           const Pose& to);

/// The shortest way from one pose to another over the cells that the platform admits; none if there is none.
[[nodiscard]] std::optional<std::vector<Pose>> grid_path(const OccupancyMap& map, const Platform& platform,
                                                         const Pose& from, const Pose& to);

}  // namespace vantage
