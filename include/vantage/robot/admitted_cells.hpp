// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The known cells of a map that a platform admits (Platform::admits_cell), kept up to date by what is written to the
/// map.
///
///     AdmittedCells admitted;
///     map.insert(scan);
///     admitted.follow(map, platform);  // costs what the scan changed
///     const ReachableSpace space(map, platform, pose, admitted);
///
/// At every moment it holds what a new one would, whatever the way by which the map came there.
class AdmittedCells {
 public:
  /// Brings it up to date. Another map or another platform than the last is taken from its beginning; cells are asked
  /// again only where one no further off than Platform::reach_m has become clear, or is clear no more.
  void follow(const OccupancyMap& map, const Platform& platform);

  /// The cells.
  [[nodiscard]] const BrickSet& cells() const { return cells_; }
  /// Whether the platform admits a cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return cells_.contains(cell); }

 private:
  void ask(const OccupancyMap& map, const Platform& platform, const VoxelBox& bricks);

  KnownMap map_;
  const Platform* platform_ = nullptr;
  OccupancyMap::Revision followed_ = 0;
  BrickSet clear_;  // what bodies may touch, as followed last
  BrickSet cells_;
};

}  // namespace vantage
