// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vantage/geometry/voxel.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vector>

namespace vantage::detail {

/// What the cells of a zone are.
enum class ZoneKind : std::uint8_t { None, Free, Unknown };

/// Cells of one kind that are connected through faces within a block.
struct Zone {
  ZoneKind kind = ZoneKind::None;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< mean of its cells, world
  std::size_t cells = 0;
  std::vector<std::size_t> beside = {};  ///< zones that touch it through faces, ascending
};

/// Divides a box of cells into zones.
class Zones {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// `kind_of` is asked once for each cell of `box`. A block has `side` cells along each axis.
  Zones(const VoxelFrame& frame, const VoxelBox& box, std::int32_t side,
        const std::function<ZoneKind(const VoxelIndex&)>& kind_of);

  [[nodiscard]] const std::vector<Zone>& all() const { return zones_; }
  /// The zone of a cell, or kNone.
  [[nodiscard]] std::size_t zone_of(const VoxelIndex& cell) const;
  /// Lengths of the shortest paths from a zone to all others, over the centres of zones that touch; a step to or from
  /// unknown space counts twice. Infinite if there is no way.
  [[nodiscard]] std::vector<double> lengths_from(std::size_t zone) const;

 private:
  VoxelGrid<std::uint32_t> numbers_;  // of the zone of each cell, plus one; 0: none
  std::vector<Zone> zones_;
};

}  // namespace vantage::detail
