// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace VANTAGE_EXPORT vantage {

/// Keeps an OccupancyMap synchronised with the map of a host, so that the host does not map twice:
///
///     struct HostMap {
///       vantage::Occupancy at(const vantage::VoxelIndex& cell) const;
///     };
///     MapFollower follower({.resolution_m = 0.1});
///     loop { host.integrate(scan); follower.update(host_map, box_that_changed); planner->plan(follower.map(),
///     pose); }
///
/// A host that also answers `log_odds(cell)` (LogOddsLookup) is asked for these, and its map is mirrored with them,
/// clamped and rounded to a step. Otherwise every cell is as `OccupancyMap::set` leaves it: at a clamping limit,
/// never contested. The resolution and the alignment of the cells are those of the host: VoxelFrame.
class MapFollower {
 public:
  /// Starts with an empty map. Errors as OccupancyMap.
  explicit MapFollower(const OccupancyMapOptions& options) : map_(options) {}
  /// Starts with a map that is already a mirror of the host's.
  explicit MapFollower(OccupancyMap map) : map_(std::move(map)) {}

  /// The synchronised map.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }

  /// Asks the host for the cells of a box, or of a set, that lie in the region of the map, and for no other; writes
  /// the bricks that differ. One call is one revision, also if nothing differs, because planners take a scan that
  /// changes nothing as evidence: call it once after each scan. Returns the number of cells that changed their state.
  /// The memory limit of the map is kept to: a cell that does not fit stays unknown and is counted
  /// (OccupancyMap::cells_refused).
  ///
  /// Throws std::invalid_argument, before it asks, if a cell is not addressable or the box holds more than
  /// OccupancyMap::kMaxBoxCells cells of the region; for log-odds that are not a number; and what the host throws.
  template <class Host>
  requires OccupancyLookup<Host> || LogOddsLookup<Host> std::size_t update(const Host& host,
                                                                           const VoxelBox& changed) {
    const VoxelBox cells = begin(changed);
    std::size_t count = 0;
    for_each_cell(Brick::over(cells),
                  [&](const VoxelIndex& brick) { count += mirror(host, brick, plane_of(brick, cells)); });
    return count;
  }
  /// Updates the cells of a set (blocks of a host, or single cells) as the overload for a box does.
  template <class Host>
  requires OccupancyLookup<Host> || LogOddsLookup<Host> std::size_t update(const Host& host,
                                                                           const BrickSet& changed) {
    begin(changed);
    std::size_t count = 0;
    changed.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) {
      count += mirror(host, brick, map_.in_region(brick, cells));
    });
    return count;
  }

 private:
  template <class Host>
  std::size_t mirror(const Host& host, const VoxelIndex& brick, const BrickPlane& asked) {
    Brick cells;
    for_each_offset(asked, [&](std::size_t offset) {
      const VoxelIndex cell = Brick::cell_at(brick, offset);
      if constexpr (LogOddsLookup<Host>) {
        put_log_odds(offset, host.log_odds(cell), cells);
      } else {
        put(offset, host.at(cell), cells);
      }
    });
    return take(brick, asked, cells);
  }

  VoxelBox begin(const VoxelBox& changed);
  void begin(const BrickSet& changed);
  static BrickPlane plane_of(const VoxelIndex& brick, const VoxelBox& cells);
  std::size_t take(const VoxelIndex& brick, const BrickPlane& asked, const Brick& cells);
  void put(std::size_t offset, Occupancy state, Brick& cells) const {
    const std::int8_t steps = state == Occupancy::Unknown ? std::int8_t{0}
                              : state == Occupancy::Free  ? map_.min_steps_
                                                          : map_.max_steps_;
    put(offset, state, steps, cells);
  }
  void put_log_odds(std::size_t offset, std::optional<double> log_odds, Brick& cells) const;
  static void put(std::size_t offset, Occupancy state, std::int8_t steps, Brick& cells) {
    const std::size_t word = offset >> 6U;
    const std::size_t bit = offset & 63U;
    cells.known[word] |= std::uint64_t{state != Occupancy::Unknown} << bit;
    cells.occupied[word] |= std::uint64_t{state == Occupancy::Occupied} << bit;
    cells.log_odds[offset] = steps;
  }

  OccupancyMap map_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/map_follower.ipp>
#endif
