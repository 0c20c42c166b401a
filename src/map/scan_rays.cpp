// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map/scan_rays.hpp>
#include <stdexcept>
#include <string>

namespace vantage {
namespace {

void validate(const Scan& scan) {
  if (!is_rigid(scan.world_from_sensor)) {
    throw std::invalid_argument("Scan::world_from_sensor is not a rigid transform (finite, orthonormal, determinant +1)");
  }
  if (!(scan.max_range_m > 0.0)) {
    throw std::invalid_argument("Scan::max_range_m is " + std::to_string(scan.max_range_m) + ", must be > 0");
  }
}

class RayCollector {
 public:
  RayCollector(const Scan& scan, const VoxelFrame& frame, ScanRays& rays)
      : frame_(frame),
        max_range_m_(scan.max_range_m),
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
    const double range_m = std::sqrt(squared_m2);
    const bool ends_here = is_return && range_m <= max_range_m_;
    const Eigen::Vector3d reach = ends_here ? point_sensor : Eigen::Vector3d(point_sensor * (max_range_m_ / range_m));
    const Eigen::Vector3d end = rotation_ * reach + origin_;
    if (!origin_addressable_ || !(end.array().abs() <= furthest_m_).all()) {
      ++report.not_addressable;
      return;
    }
    ++(ends_here ? report.hits : is_return ? report.beyond_range : report.no_return);
    rays_.rays.push_back({end, frame_.cell_of(end), ends_here});
    ends_.extend(end);
  }
  [[nodiscard]] const Box& ends() const { return ends_; }

 private:
  VoxelFrame frame_;
  double max_range_m_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d origin_;
  double furthest_m_;
  bool origin_addressable_;
  ScanRays& rays_;
  Box ends_;
};

}  // namespace

ScanRays rays_of(const Scan& scan, const VoxelFrame& frame) {
  validate(scan);
  ScanRays rays;
  rays.origin = scan.world_from_sensor.translation();
  rays.rays.reserve(scan.points.size() + scan.no_return.size());
  RayCollector collector(scan, frame, rays);
  for (const Eigen::Vector3f& point : scan.points) {
    collector.add(point, true);
  }
  for (const Eigen::Vector3f& direction : scan.no_return) {
    collector.add(direction, false);
  }
  if (!rays.rays.empty()) {
    Box box = collector.ends();
    box.extend(rays.origin);
    rays.cells = {frame.cell_of(box.min), frame.cell_of(box.max) + VoxelIndex{1, 1, 1}};
  }
  return rays;
}

}  // namespace vantage
