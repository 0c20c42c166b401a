// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <vantage/sim/simulated_sensor.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace {

void validate(const SensorNoise& noise) {
  detail::require_option(noise.axial >= 0.0 && noise.axial <= 1000.0, "SensorNoise::axial", noise.axial,
                         "in [0, 1000]");
  detail::require_option(noise.dropped_share >= 0.0 && noise.dropped_share <= 1.0, "SensorNoise::dropped_share",
                         noise.dropped_share, "in [0, 1]");
  detail::require_option(noise.position_m >= 0.0 && noise.position_m <= 10.0, "SensorNoise::position_m",
                         noise.position_m, "in [0, 10]");
  detail::require_option(noise.angle_rad >= 0.0 && noise.angle_rad <= std::numbers::pi, "SensorNoise::angle_rad",
                         noise.angle_rad, "in [0, pi]");
}

// Random numbers made from the bits of the engine, because the distributions differ between standard libraries.
class Chance {
 public:
  Chance(std::uint64_t seed, std::uint64_t scan) : engine_(seed * 0x9E3779B97F4A7C15ULL + scan) {}
  double uniform() { return (static_cast<double>(engine_() >> 11U) + 0.5) * 0x1p-53; }
  // Standard normal (Box & Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

// The true pose of a sensor that is reported at `pose`.
Pose misplaced(const Pose& pose, const SensorNoise& noise, Chance& chance) {
  Pose actual = pose;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    actual.translation()[axis] += noise.position_m * chance.normal();
    actual.linear() = actual.linear() * Eigen::AngleAxisd(noise.angle_rad * chance.normal(),
                                                          Eigen::Vector3d(Eigen::Vector3d::Unit(axis)));
  }
  return actual;
}

double kinect_sigma_m(double depth_m) { return 0.0012 + 0.0019 * (depth_m - 0.4) * (depth_m - 0.4); }

}  // namespace

SimulatedSensor::SimulatedSensor(const TriangleScene& scene, const RangeSensor& sensor, const SensorNoise& noise,
                                 std::uint64_t seed)
    : scene_(scene), sensor_(sensor), noise_(noise), seed_(seed) {
  sensor.validate();
  validate(noise);
  directions_.reserve(sensor.width * sensor.height);
  for (std::size_t row = 0; row < sensor.height; ++row) {
    for (std::size_t column = 0; column < sensor.width; ++column) {
      directions_.push_back(sensor.direction(column, row));
    }
  }
}

Scan SimulatedSensor::scan(const Pose& world_from_sensor) {
  if (!is_rigid(world_from_sensor)) {
    throw std::invalid_argument("SimulatedSensor::scan: the pose is not a rigid transform");
  }
  Chance chance(seed_, scans_++);
  const bool noisy = noise_.axial > 0.0 || noise_.dropped_share > 0.0;
  const bool pinhole = sensor_.projection == RangeSensor::Projection::Pinhole;
  Scan scan;
  scan.world_from_sensor = world_from_sensor;
  scan.max_range_m = sensor_.max_range_m;
  scan.points.reserve(directions_.size());
  const Eigen::Vector3f nothing = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  const bool misplaces = noise_.position_m > 0.0 || noise_.angle_rad > 0.0;
  const Pose actual = misplaces ? misplaced(world_from_sensor, noise_, chance) : world_from_sensor;
  const Eigen::Vector3d origin = actual.translation();
  for (const Eigen::Vector3d& direction : directions_) {
    const std::optional<double> range_m =
        scene_.hit_distance(origin, actual.linear() * direction, sensor_.max_range_m);
    if (!range_m) {
      if (sensor_.reports_no_return) {
        scan.no_return.emplace_back(direction.cast<float>());
      } else {
        scan.points.push_back(nothing);
      }
      continue;
    }
    double measured_m = *range_m;
    if (noisy) {
      if (chance.uniform() < noise_.dropped_share) {
        scan.points.push_back(nothing);
        continue;
      }
      const double along_axis = pinhole ? direction.z() : 1.0;
      measured_m += noise_.axial * kinect_sigma_m(measured_m * along_axis) * chance.normal() / along_axis;
    }
    const bool returns = measured_m > 0.0 && *range_m >= sensor_.min_range_m;
    scan.points.push_back(returns ? Eigen::Vector3f((measured_m * direction).cast<float>()) : nothing);
  }
  if (scan.no_return.empty()) {
    scan.width = sensor_.width;
    scan.height = sensor_.height;
  }
  return scan;
}

}  // namespace vantage
