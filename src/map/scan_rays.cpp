// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <map/scan_rays.hpp>
#include <map/validate_scan.hpp>

namespace vantage {
namespace {

class RayCollector {
 public:
  RayCollector(const Scan& scan, const VoxelFrame& frame, RayPolicy policy, ScanRays& rays)
      : frame_(frame),
        each_end_cell_(policy == RayPolicy::EachEndCell),
        max_range_m_(scan.max_range_m),
        unlimited_(std::isinf(scan.max_range_m)),
        rotation_(scan.world_from_sensor.linear()),
        origin_(scan.world_from_sensor.translation()),
        furthest_m_(frame.size_m * kFurthestVoxel),
        origin_addressable_(frame.addressable(origin_)),
        rays_(rays) {}

  void add(const Eigen::Vector3f& point, bool is_return) {
    ScanReport& report = rays_.report;
    const Eigen::Vector3d point_sensor = point.cast<double>();
    // The square of a finite float is finite in double, and zero only for zero.
    const double squared_m2 = point_sensor.squaredNorm();
    if (!(squared_m2 <= std::numeric_limits<double>::max())) {
      ++report.not_finite;
      return;
    }
    if (squared_m2 == 0.0) {
      ++report.zero_length;
      return;
    }
    bool ends_here = is_return;
    Eigen::Vector3d reach = point_sensor;
    if (!is_return || !unlimited_) {
      const double range_m = std::sqrt(squared_m2);
      ends_here = is_return && range_m <= max_range_m_;
      reach = ends_here ? point_sensor : Eigen::Vector3d(point_sensor * (max_range_m_ / range_m));
    }
    const Eigen::Vector3d end = rotation_ * reach + origin_;
    if (ends_here && well_inside_last(end)) {
      ++report.hits;
      return;
    }
    if (!origin_addressable_ || !(end.array().abs() <= furthest_m_).all()) {
      ++report.not_addressable;
      return;
    }
    ++(ends_here ? report.hits : is_return ? report.beyond_range : report.no_return);
    const VoxelIndex cell = frame_.cell_of(end);
    rays_.rays.push_back({end, cell, ends_here});
    if (each_end_cell_ && ends_here) {
      last_centre_ = frame_.centre_of(cell);
    }
  }

 private:
  // Whether a point lies in the cell of the last return drawn, by a margin that rounding cannot bridge.
  [[nodiscard]] bool well_inside_last(const Eigen::Vector3d& end) const {
    const double reach_m = frame_.size_m * (0.5 - 1e-6);
    return (std::abs(end.x() - last_centre_.x()) < reach_m) && (std::abs(end.y() - last_centre_.y()) < reach_m) &&
           (std::abs(end.z() - last_centre_.z()) < reach_m);
  }

  VoxelFrame frame_;
  bool each_end_cell_;
  double max_range_m_;
  bool unlimited_;
  Eigen::Vector3d last_centre_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d origin_;
  double furthest_m_;
  bool origin_addressable_;
  ScanRays& rays_;
};

}  // namespace

ScanRays rays_of(const Scan& scan, const VoxelFrame& frame, RayPolicy policy) {
  detail::validate(scan);
  ScanRays rays;
  rays.origin = scan.world_from_sensor.translation();
  if (policy == RayPolicy::EveryReturn) {
    rays.rays.reserve(scan.points.size() + scan.no_return.size());
  }
  RayCollector collector(scan, frame, policy, rays);
  for (const Eigen::Vector3f& point : scan.points) {
    collector.add(point, true);
  }
  for (const Eigen::Vector3f& direction : scan.no_return) {
    collector.add(direction, false);
  }
  if (!rays.rays.empty()) {
    VoxelIndex lo = frame.cell_of(rays.origin);
    VoxelIndex hi = lo;
    for (const ScanRay& ray : rays.rays) {
      lo = {std::min(lo.x, ray.cell.x), std::min(lo.y, ray.cell.y), std::min(lo.z, ray.cell.z)};
      hi = {std::max(hi.x, ray.cell.x), std::max(hi.y, ray.cell.y), std::max(hi.z, ray.cell.z)};
    }
    rays.cells = {lo, hi + VoxelIndex{1, 1, 1}};
  }
  return rays;
}

}  // namespace vantage
