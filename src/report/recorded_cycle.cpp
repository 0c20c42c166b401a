// SPDX-License-Identifier: MIT
#include <vantage/report/recorded_cycle.hpp>

namespace vantage {

void apply_changes(const RecordedCycle& cycle, OccupancyMap& map) {
  for (const BrickState& change : cycle.changes) {
    const Brick* brick = map.find_brick(change.brick);
    const BrickPlane known = brick == nullptr ? BrickPlane{} : brick->known;
    const BrickPlane occupied = brick == nullptr ? BrickPlane{} : brick->occupied;
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      const std::uint64_t differs = (known[word] ^ change.known[word]) | (occupied[word] ^ change.occupied[word]);
      for_each_offset(differs, word, [&](std::size_t offset) {
        const std::uint64_t bit = std::uint64_t{1} << (offset & 63U);
        const Occupancy state = (change.known[word] & bit) == 0      ? Occupancy::Unknown
                                : (change.occupied[word] & bit) == 0 ? Occupancy::Free
                                                                     : Occupancy::Occupied;
        map.set(Brick::cell_at(change.brick, offset), state);
      });
    }
  }
}

}  // namespace vantage
