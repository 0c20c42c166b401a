// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The known cells of a map that a platform admits (Platform::admits_cell), updated from the change log of the map.
///
///     AdmittedCells admitted;
///     map.insert(scan);
///     admitted.follow(map, platform);  // the cost follows what the scan changed
///
/// The content is always the same as that of a new object that follows the map once.
class AdmittedCells {
 public:
  /// Updates the content. Starts anew if the map or the platform is another one than in the last call. Otherwise only
  /// cells within Platform::reach_m of a cell that became clear or stopped being clear are tested again.
  void follow(const OccupancyMap& map, const Platform& platform);

  /// Whether the last `follow` started anew.
  [[nodiscard]] bool started_anew() const { return started_anew_; }
  /// The bricks whose admitted cells the last `follow` has changed.
  [[nodiscard]] const std::vector<VoxelIndex>& changed() const { return changed_; }
  /// The admitted cells.
  [[nodiscard]] const BrickSet& cells() const { return cells_; }
  /// Whether the platform admits a known cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return cells_.contains(cell); }

 private:
  void ask(const OccupancyMap& map, const Platform& platform, const VoxelBox& bricks);

  KnownMap map_;
  const Platform* platform_ = nullptr;
  OccupancyMap::Revision followed_ = 0;
  BrickSet clear_;  // clear cells at the last follow
  BrickSet cells_;
  std::vector<VoxelIndex> changed_;
  bool started_anew_ = true;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/admitted_cells.ipp>
#endif
