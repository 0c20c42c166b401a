// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan_cells.hpp>

namespace vantage {

ScanReport OccupancyMap::insert(const Scan& scan, RayPolicy policy) {
  const ScanCells cells = scan_cells(scan, frame_, policy, region_);
  ScanReport report = cells.report;
  ++revision_;
  const auto update = [&](const VoxelIndex& cell, std::int8_t delta) {
    const Occupancy before = at(cell);
    const Brick* brick = find_brick(Brick::of_cell(cell));
    const int steps = (brick == nullptr ? 0 : brick->log_odds[Brick::offset_of(cell)]) + delta;
    const auto clamped = static_cast<std::int8_t>(std::clamp<int>(steps, min_steps_, max_steps_));
    const Occupancy after = clamped >= 0 ? Occupancy::Occupied : Occupancy::Free;
    write(cell, after, clamped);
    report.cells_changed += before != after ? 1 : 0;
  };
  for (const VoxelIndex& cell : cells.hit) {
    update(cell, hit_steps_);
  }
  for (const VoxelIndex& cell : cells.cleared) {
    update(cell, miss_steps_);
  }
  return report;
}

}  // namespace vantage
