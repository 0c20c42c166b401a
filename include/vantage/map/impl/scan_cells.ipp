// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/impl/grazed_cells.hpp>
#include <vantage/map/impl/sensor_frame.hpp>
#include <vantage/map/impl/validate_scan.hpp>
#include <vantage/map/scan_cells.hpp>

namespace vantage {
namespace detail {

class Walker {
 public:
  Walker(const OccupancyMap& map, const Eigen::Vector3d& origin, ScanCells& cells)
      : map_(map), origin_(origin), cells_(cells) {}

  void hit(const Eigen::Vector3d& end) {
    clear_before(end, true);
    if (map_.in_region(map_.frame().cell_of(end))) {
      cells_.hit.insert(map_.frame().cell_of(end));
    }
  }
  // As in OctoMap, the end cell of a ray without a return is not cleared.
  void clear_before(const Eigen::Vector3d& end, bool is_return = false) {
    const VoxelIndex last = map_.frame().cell_of(end);
    const VoxelRay ray(map_.frame(), origin_, end);
    for (const VoxelIndex& cell : ray) {
      if (cell != last && map_.in_region(cell)) {
        cells_.cleared.insert(cell);
      }
    }
    if (map_.options().keep_grazed_cells) {
      (void)ray.all_from_the_end([&](const VoxelIndex& cell) {
        const bool in_surface = map_.at(cell) == Occupancy::Occupied;
        if (in_surface) {
          grazed_.insert(cell);
        }
        return in_surface || (is_return && cell == last);
      });
    }
  }
  // Called after all rays: removes the cells that do not count as passed.
  void spare_grazed_and_hit() {
    const VoxelIndex sensor = map_.frame().cell_of(origin_);
    std::erase_if(cells_.cleared, [&](const VoxelIndex& cell) {
      return cells_.hit.contains(cell) || grazed_.contains(cell) ||
             (map_.options().keep_grazed_cells && map_.at(cell) == Occupancy::Occupied &&
              (beyond_erase_range(map_.options(), sensor, cell) || touches_a_hit(cell)));
    });
  }

 private:
  [[nodiscard]] bool touches_a_hit(const VoxelIndex& cell) const {
    bool touches = false;
    for_each_cell(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(1),
                  [&](const VoxelIndex& other) { touches = touches || cells_.hit.contains(other); });
    return touches;
  }

  const OccupancyMap& map_;
  const Eigen::Vector3d& origin_;
  ScanCells& cells_;
  std::unordered_set<VoxelIndex> grazed_;
};

}  // namespace detail

VANTAGE_INLINE ScanCells scan_cells(const Scan& scan, const OccupancyMap& map, RayPolicy policy) {
  detail::validate(scan.view());
  const VoxelFrame& frame = map.frame();
  ScanCells cells;
  ScanReport& report = cells.report;
  const Eigen::Vector3d origin = scan.world_from_sensor.translation();
  const detail::SensorFrame sensor(scan.world_from_sensor);
  detail::Walker walk(map, origin, cells);
  std::unordered_set<VoxelIndex> end_cells;

  const auto shoot = [&](const Eigen::Vector3d& point_sensor, bool is_return) {
    const double range_m =
        std::sqrt(detail::SensorFrame::squared(point_sensor.x(), point_sensor.y(), point_sensor.z()));
    if (!std::isfinite(range_m)) {
      ++report.not_finite;
      return;
    }
    if (range_m == 0.0) {
      ++report.zero_length;
      return;
    }
    const bool ends_here = is_return && range_m <= scan.max_range_m;
    const Eigen::Vector3d reach =
        ends_here ? point_sensor : Eigen::Vector3d(point_sensor * (scan.max_range_m / range_m));
    const Eigen::Vector3d end(sensor.world(0, reach.x(), reach.y(), reach.z()),
                              sensor.world(1, reach.x(), reach.y(), reach.z()),
                              sensor.world(2, reach.x(), reach.y(), reach.z()));
    if (!frame.addressable(origin) || !frame.addressable(end)) {
      ++report.not_addressable;
      return;
    }
    ++(ends_here ? report.hits : is_return ? report.beyond_range : report.no_return);
    if (!ends_here) {
      walk.clear_before(end);
    } else if (policy == RayPolicy::EveryReturn) {
      walk.hit(end);
    } else if (end_cells.insert(frame.cell_of(end)).second) {
      walk.hit(frame.centre_of(frame.cell_of(end)));
    }
  };
  for (const Eigen::Vector3f& point : scan.points) {
    shoot(point.cast<double>(), true);
  }
  for (const Eigen::Vector3f& direction : scan.no_return) {
    shoot(direction.cast<double>(), false);
  }
  walk.spare_grazed_and_hit();
  report.cells_hit = cells.hit.size();
  report.cells_cleared = cells.cleared.size();
  return cells;
}

}  // namespace vantage
