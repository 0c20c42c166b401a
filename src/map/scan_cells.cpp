// SPDX-License-Identifier: MIT
#include <cmath>
#include <map/sensor_frame.hpp>
#include <map/validate_scan.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/scan_cells.hpp>

namespace vantage {
namespace {

class Walker {
 public:
  Walker(const VoxelFrame& frame, const std::optional<VoxelBox>& region, const Eigen::Vector3d& origin,
         ScanCells& cells)
      : frame_(frame), region_(region), origin_(origin), cells_(cells) {}

  void hit(const Eigen::Vector3d& end) {
    clear_before(end);
    if (in_region(frame_.cell_of(end))) {
      cells_.hit.insert(frame_.cell_of(end));
    }
  }
  // As OctoMap: the cell in which the ray ends without a return is left alone.
  void clear_before(const Eigen::Vector3d& end) {
    const VoxelIndex last = frame_.cell_of(end);
    for (const VoxelIndex& cell : VoxelRay(frame_, origin_, end)) {
      if (cell != last && in_region(cell)) {
        cells_.cleared.insert(cell);
      }
    }
  }

 private:
  bool in_region(const VoxelIndex& cell) const { return !region_ || region_->contains(cell); }

  const VoxelFrame& frame_;
  const std::optional<VoxelBox>& region_;
  const Eigen::Vector3d& origin_;
  ScanCells& cells_;
};

}  // namespace

ScanCells scan_cells(const Scan& scan, const VoxelFrame& frame, RayPolicy policy,
                     const std::optional<VoxelBox>& region) {
  detail::validate(scan);
  ScanCells cells;
  ScanReport& report = cells.report;
  const Eigen::Vector3d origin = scan.world_from_sensor.translation();
  const SensorFrame sensor(scan.world_from_sensor);
  Walker walk(frame, region, origin, cells);
  std::unordered_set<VoxelIndex> end_cells;

  const auto shoot = [&](const Eigen::Vector3d& point_sensor, bool is_return) {
    const double range_m = std::sqrt(SensorFrame::squared(point_sensor.x(), point_sensor.y(), point_sensor.z()));
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
  for (const VoxelIndex& cell : cells.hit) {
    cells.cleared.erase(cell);
  }
  report.cells_hit = cells.hit.size();
  report.cells_cleared = cells.cleared.size();
  return cells;
}

}  // namespace vantage
