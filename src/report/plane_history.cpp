// SPDX-License-Identifier: MIT
#include "report/plane_history.hpp"

#include <algorithm>
#include <tuple>

namespace vantage::detail {

void PlaneHistory::set(const VoxelIndex& brick, const BrickPlane& cells, std::uint16_t now) {
  const auto found = bricks_.find(brick);
  if (found == bricks_.end() && cells == BrickPlane{}) {
    return;
  }
  Timed& timed = found == bricks_.end() ? bricks_[brick] : found->second;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    for_each_offset(timed.cells[word] & ~cells[word], word, [&](std::size_t offset) {
      if (timed.births[offset] != now) {
        ended_.push_back({Brick::cell_at(brick, offset), timed.births[offset], now});
      }
    });
    for_each_offset(cells[word] & ~timed.cells[word], word, [&](std::size_t offset) { timed.births[offset] = now; });
  }
  timed.cells = cells;
}

std::vector<TimedCell> PlaneHistory::stays() const {
  std::vector<TimedCell> stays = ended_;
  for (const auto& [brick, timed] : bricks_) {
    for_each_offset(timed.cells, [&, &brick = brick, &timed = timed](std::size_t offset) {
      stays.push_back({Brick::cell_at(brick, offset), timed.births[offset], kNever});
    });
  }
  std::sort(stays.begin(), stays.end(), [](const TimedCell& a, const TimedCell& b) {
    return std::tie(a.cell.z, a.cell.y, a.cell.x, a.birth) < std::tie(b.cell.z, b.cell.y, b.cell.x, b.birth);
  });
  return stays;
}

}  // namespace vantage::detail
