// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// `death` of what still exists.
inline constexpr std::uint16_t kNever = 0xFFFF;

/// A cell that was in a set from one view until another.
struct TimedCell {
  VoxelIndex cell;
  std::uint16_t birth = 0;
  std::uint16_t death = kNever;
};

/// Records when cells join and leave a set that is given brick by brick.
class PlaneHistory {
 public:
  /// Sets the cells of a brick that are in the set after view `now`. Views must come in order.
  void set(const VoxelIndex& brick, const BrickPlane& cells, std::uint16_t now);
  /// Every stay of a cell in the set, also those that have not ended, ordered by cell and birth.
  [[nodiscard]] std::vector<TimedCell> stays() const;

 private:
  struct Timed {
    BrickPlane cells{};
    std::vector<std::uint16_t> births = std::vector<std::uint16_t>(Brick::kCells, 0);
  };
  std::unordered_map<VoxelIndex, Timed> bricks_;
  std::vector<TimedCell> ended_;
};

}  // namespace vantage::detail
