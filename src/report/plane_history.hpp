// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// In place of the view after which something ended: it has not.
inline constexpr std::uint16_t kNever = 0xFFFF;

/// A cell that belonged to a set from one view on until another.
struct TimedCell {
  VoxelIndex cell;
  std::uint16_t birth = 0;
  std::uint16_t death = kNever;
};

/// The times at which cells joined and left a set that is told brick by brick.
class PlaneHistory {
 public:
  /// The cells of a brick in the set after view `now`; views come in order.
  void set(const VoxelIndex& brick, const BrickPlane& cells, std::uint16_t now);
  /// Every stay of a cell in the set, those that last included, ordered by cell and birth.
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
