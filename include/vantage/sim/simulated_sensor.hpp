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

/// Noise of a simulated sensor. The default is a perfect sensor.
struct SensorNoise {
  /// Standard deviation of the depth z as a multiple of that of a Kinect, 0.0012 + 0.0019 (z - 0.4)^2 metres, in
  /// [0, 1000]. For a spherical sensor the depth is the range. (Nguyen, Izadi & Lovell 2012, eq. 5)
  double axial = 0.0;
  double dropped_share = 0.0;  ///< share of the returns that are lost at random, in [0, 1]
  /// Error of the reported pose: standard deviation of the position along each axis, metres, in [0, 10].
  double position_m = 0.0;
  double angle_rad = 0.0;  ///< standard deviation of the rotation about each axis, radians, in [0, pi]
};

/// A range sensor in a world of triangles.
class SimulatedSensor {
 public:
  /// Throws std::invalid_argument with the field of the sensor or of the noise at fault.
  SimulatedSensor(const TriangleScene& scene, const RangeSensor& sensor, const SensorNoise& noise = {},
                  std::uint64_t seed = 1);

  /// Takes a scan. With pose noise it is taken near `world_from_sensor`, but reported there. Each ray appears
  /// once, row by row: as a point (NaN if the nearest surface is out of range or the return was dropped), or in
  /// `Scan::no_return` if it meets no surface within range and the sensor reports that. The scan is a depth image
  /// if every ray is a point. The noise depends on the seed and on the number of scans before, so the same
  /// sequence of poses gives the same scans. Throws std::invalid_argument for a pose that is not rigid.
  [[nodiscard]] Scan scan(const Pose& world_from_sensor);

  /// The sensor model that was passed to the constructor.
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
