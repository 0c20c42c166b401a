// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/scan.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/sim/triangle_scene.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How measurements differ from the truth. The default is a perfect sensor.
struct SensorNoise {
  /// Standard deviation of the depth z as a multiple of a Kinect's, 0.0012 + 0.0019 (z - 0.4)^2 metres (Nguyen, Izadi
  /// & Lovell 2012, eq. 5), >= 0. A spherical sensor's depth is its range.
  double axial = 0.0;
  double dropped_share = 0.0;  ///< of all returns, lost at random, in [0, 1]
  /// The sensor is not quite where it is said to be: standard deviations of its position along each axis, metres, and
  /// of its turn about each, radians, >= 0.
  double position_m = 0.0;
  double angle_rad = 0.0;  ///< see `position_m`
};

/// A range sensor in a world of triangles.
class SimulatedSensor {
 public:
  /// Throws std::invalid_argument naming the field of the sensor or of the noise at fault.
  SimulatedSensor(const TriangleScene& scene, const RangeSensor& sensor, const SensorNoise& noise = {},
                  std::uint64_t seed = 1);

  /// What the sensor measures at this pose, or near it if the noise has it so: the scan says that it was taken at
  /// this one. Each ray of the sensor once, row by row: as a point, NaN where the nearest surface is out of range or
  /// the return was dropped, or, if it meets no surface within range and the sensor reports that, in
  /// `Scan::no_return`. The scan is a depth image if every ray is a point. The noise is drawn from the seed and the
  /// number of scans before this one, so the same sequence of poses gives the same scans. Throws
  /// std::invalid_argument for a pose that is not rigid.
  [[nodiscard]] Scan scan(const Pose& world_from_sensor);

  /// The sensor simulated.
  [[nodiscard]] const RangeSensor& sensor() const { return sensor_; }

 private:
  TriangleScene scene_;
  RangeSensor sensor_;
  SensorNoise noise_;
  std::uint64_t seed_;
  std::uint64_t scans_ = 0;
  std::vector<Eigen::Vector3d> directions_;
};

}  // namespace vantage
