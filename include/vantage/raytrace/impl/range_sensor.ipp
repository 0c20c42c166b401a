// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/raytrace/range_sensor.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double degrees) { return degrees * kPi / 180.0; }

inline RangeSensor kinect() { return RangeSensor::pinhole(640, 480, radians(57.0), radians(43.0), 0.4, 4.0); }

// Shade & Newman 2011, VI: a stereo camera with a field of view of 65 degrees and 512 x 384 pixels. The vertical
// field of view follows from square pixels.
inline RangeSensor stereo() {
  const double vertical_fov_rad = 2.0 * std::atan(std::tan(radians(65.0) / 2.0) * 384.0 / 512.0);
  return RangeSensor::pinhole(512, 384, radians(65.0), vertical_fov_rad, 0.5, 5.0);
}

// The depth camera of a RealSense D435 in its 640 x 360 mode.
inline RangeSensor realsense() { return RangeSensor::pinhole(640, 360, radians(87.0), radians(58.0), 0.3, 3.0); }

// A spinning lidar with 128 beams over 90 degrees. At 10 m, neighbouring beams are 0.12 m apart, columns 0.06 m.
inline RangeSensor lidar() {
  RangeSensor sensor = RangeSensor::spherical(1024, 128, 2.0 * kPi, kPi / 2.0, 0.1, 20.0);
  sensor.reports_no_return = true;
  return sensor;
}

// Half a degree in both directions: at 10 m, neighbouring rays are 0.09 m apart.
inline RangeSensor panoramic() {
  RangeSensor sensor = RangeSensor::spherical(720, 360, 2.0 * kPi, kPi, 0.0, 20.0);
  sensor.reports_no_return = true;
  return sensor;
}

// Vasquez-Gomez et al. 2013: these half angles belong to the outermost *rays*, not to the edges of the outermost
// pixels. (Their rays are spaced by equal angles, those of a pinhole by equal tangents; the difference is at most 8
// mm per metre.)
inline RangeSensor vpl() {
  RangeSensor sensor;
  sensor.width = 176;
  sensor.height = 144;
  sensor.cx = 87.5;
  sensor.cy = 71.5;
  sensor.fx = sensor.cx / std::tan(radians(22.06));
  sensor.fy = sensor.cy / std::tan(radians(18.76));
  sensor.min_range_m = 0.0;
  sensor.max_range_m = 4.0;
  return sensor;
}

using Preset = std::pair<std::string_view, RangeSensor (*)()>;
inline constexpr std::array<Preset, 6> kPresets{{{"kinect", &kinect},
                                                 {"stereo", &stereo},
                                                 {"realsense", &realsense},
                                                 {"lidar", &lidar},
                                                 {"panoramic", &panoramic},
                                                 {"vpl", &vpl}}};

inline void validate_pinhole(const RangeSensor& sensor) {
  const auto is_focal_length = [](double value) { return value >= 1e-3 && value <= 1e7; };
  const auto is_pixel = [](double value) { return std::abs(value) <= 1e6; };
  detail::require_option(is_focal_length(sensor.fx), "RangeSensor::fx", sensor.fx, "in [1e-3, 1e7]");
  detail::require_option(is_focal_length(sensor.fy), "RangeSensor::fy", sensor.fy, "in [1e-3, 1e7]");
  detail::require_option(is_pixel(sensor.cx), "RangeSensor::cx", sensor.cx, "in [-1e6, 1e6]");
  detail::require_option(is_pixel(sensor.cy), "RangeSensor::cy", sensor.cy, "in [-1e6, 1e6]");
}

// Allows a full turn that is written as 6.2832.
inline constexpr double kAngleSlackRad = 1e-3;
inline constexpr double kLeastAngleRad = 1e-4;

inline void validate_spherical(const RangeSensor& sensor) {
  detail::require_option(
      sensor.horizontal_fov_rad >= kLeastAngleRad && sensor.horizontal_fov_rad <= 2.0 * kPi + kAngleSlackRad,
      "RangeSensor::horizontal_fov_rad", sensor.horizontal_fov_rad, "in [1e-4, 2 pi]");
  detail::require_option(sensor.vertical_fov_rad >= kLeastAngleRad && sensor.vertical_fov_rad <= kPi + kAngleSlackRad,
                         "RangeSensor::vertical_fov_rad", sensor.vertical_fov_rad, "in [1e-4, pi]");
}

// At least one ray, and no more than the sensor has.
inline std::size_t rays_needed(double needed, std::size_t has) {
  return needed >= static_cast<double>(has) ? has
                                            : std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(needed)));
}

}  // namespace detail

VANTAGE_INLINE RangeSensor RangeSensor::pinhole(std::size_t width, std::size_t height, double horizontal_fov_rad,
                                                double vertical_fov_rad, double min_range_m, double max_range_m) {
  detail::require_option(horizontal_fov_rad > 0.0 && horizontal_fov_rad < detail::kPi,
                         "RangeSensor::horizontal_fov_rad", horizontal_fov_rad, "in (0, pi) for a pinhole");
  detail::require_option(vertical_fov_rad > 0.0 && vertical_fov_rad < detail::kPi, "RangeSensor::vertical_fov_rad",
                         vertical_fov_rad, "in (0, pi) for a pinhole");
  RangeSensor sensor;
  sensor.width = width;
  sensor.height = height;
  // Pixel centres have whole coordinates. The field of view reaches from the outer edge of the first pixel, -0.5, to
  // that of the last.
  sensor.fx = 0.5 * static_cast<double>(width) / std::tan(0.5 * horizontal_fov_rad);
  sensor.fy = 0.5 * static_cast<double>(height) / std::tan(0.5 * vertical_fov_rad);
  sensor.cx = 0.5 * (static_cast<double>(width) - 1.0);
  sensor.cy = 0.5 * (static_cast<double>(height) - 1.0);
  sensor.min_range_m = min_range_m;
  sensor.max_range_m = max_range_m;
  sensor.validate();
  return sensor;
}

VANTAGE_INLINE RangeSensor RangeSensor::spherical(std::size_t width, std::size_t height, double horizontal_fov_rad,
                                                  double vertical_fov_rad, double min_range_m, double max_range_m) {
  RangeSensor sensor;
  sensor.projection = Projection::Spherical;
  sensor.width = width;
  sensor.height = height;
  sensor.horizontal_fov_rad = horizontal_fov_rad;
  sensor.vertical_fov_rad = vertical_fov_rad;
  sensor.min_range_m = min_range_m;
  sensor.max_range_m = max_range_m;
  sensor.validate();
  return sensor;
}

VANTAGE_INLINE RangeSensor RangeSensor::preset(std::string_view name) {
  const auto found = std::find_if(detail::kPresets.begin(), detail::kPresets.end(),
                                  [&](const detail::Preset& p) { return p.first == name; });
  if (found != detail::kPresets.end()) {
    return found->second();
  }
  std::string message = "there is no sensor \"" + std::string(name) + "\"; there are";
  for (std::size_t i = 0; i < detail::kPresets.size(); ++i) {
    message += (i == 0 ? " " : ", ") + std::string(detail::kPresets[i].first);
  }
  throw std::invalid_argument(message);
}

VANTAGE_INLINE const std::vector<std::string_view>& RangeSensor::preset_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    all.reserve(detail::kPresets.size());
    for (const detail::Preset& preset : detail::kPresets) {
      all.push_back(preset.first);
    }
    return all;
  }();
  return names;
}

VANTAGE_INLINE void RangeSensor::validate() const {
  detail::require_option(width > 0, "RangeSensor::width", width, "> 0");
  detail::require_option(height > 0, "RangeSensor::height", height, "> 0");
  // divided, because the product might overflow
  detail::require_option(width <= kMostRays && height <= kMostRays / width, "RangeSensor::width", width,
                         "at most 16777216 / height: no more rays than that");
  detail::require_option(std::isfinite(min_range_m) && min_range_m >= 0.0, "RangeSensor::min_range_m", min_range_m,
                         ">= 0");
  detail::require_option(max_range_m > min_range_m && max_range_m <= 1e4, "RangeSensor::max_range_m", max_range_m,
                         "> min_range_m and at most 10000");
  if (projection == Projection::Pinhole) {
    detail::validate_pinhole(*this);
  } else {
    detail::validate_spherical(*this);
  }
}

// In the sensor frame: x to the right, y down, z forwards. The rays of a spherical sensor are spaced by equal angles
// and start half a step inside the field of view.
VANTAGE_INLINE Eigen::Vector3d RangeSensor::direction(std::size_t column, std::size_t row) const {
  if (projection == Projection::Pinhole) {
    return Eigen::Vector3d((static_cast<double>(column) - cx) / fx, (static_cast<double>(row) - cy) / fy, 1.0)
        .normalized();
  }
  const double right_rad =
      horizontal_fov_rad * ((static_cast<double>(column) + 0.5) / static_cast<double>(width) - 0.5);
  const double down_rad = vertical_fov_rad * ((static_cast<double>(row) + 0.5) / static_cast<double>(height) - 0.5);
  return {std::cos(down_rad) * std::sin(right_rad), std::sin(down_rad), std::cos(down_rad) * std::cos(right_rad)};
}

VANTAGE_INLINE std::vector<Eigen::Vector3f> RangeSensor::directions() const {
  std::vector<Eigen::Vector3f> all;
  all.reserve(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      all.push_back(direction(column, row).cast<float>());
    }
  }
  return all;
}

VANTAGE_INLINE bool RangeSensor::in_view(const Eigen::Vector3d& direction) const {
  if (!direction.allFinite() || direction.isZero(0.0)) {
    return false;
  }
  if (projection == Projection::Pinhole) {
    if (direction.z() <= 0.0) {
      return false;
    }
    const double u = fx * direction.x() / direction.z() + cx;
    const double v = fy * direction.y() / direction.z() + cy;
    return u >= -0.5 && u < static_cast<double>(width) - 0.5 && v >= -0.5 && v < static_cast<double>(height) - 0.5;
  }
  constexpr double kRounding = 1e-9;  // a full sphere must contain its own poles and its seam
  const double level = std::hypot(direction.x(), direction.z());
  return std::abs(std::atan2(direction.y(), level)) <= 0.5 * vertical_fov_rad + kRounding &&
         std::abs(std::atan2(direction.x(), direction.z())) <= 0.5 * horizontal_fov_rad + kRounding;
}

// The optical axis of a pinhole need not be in the middle, so both sides are added up.
VANTAGE_INLINE double RangeSensor::horizontal_angle_rad() const {
  return projection == Projection::Spherical
             ? horizontal_fov_rad
             : std::atan((cx + 0.5) / fx) + std::atan((static_cast<double>(width) - 0.5 - cx) / fx);
}

VANTAGE_INLINE bool RangeSensor::looks_all_around() const {
  constexpr double kRounding = 1e-3;
  return horizontal_angle_rad() >= 2.0 * detail::kPi - kRounding;
}

VANTAGE_INLINE double RangeSensor::vertical_angle_rad() const {
  return projection == Projection::Spherical
             ? vertical_fov_rad
             : std::atan((cy + 0.5) / fy) + std::atan((static_cast<double>(height) - 0.5 - cy) / fy);
}

VANTAGE_INLINE double RangeSensor::resolving_range_m(double cell_m) const {
  // The rays of a pinhole are furthest apart at the principal point: 1 / f at unit distance.
  const bool pinhole = projection == Projection::Pinhole;
  const double across = pinhole ? 1.0 / fx : horizontal_fov_rad / static_cast<double>(width);
  const double down = pinhole ? 1.0 / fy : vertical_fov_rad / static_cast<double>(height);
  return cell_m / std::max(across, down);
}

VANTAGE_INLINE RangeSensor RangeSensor::rays_for(double cell_m) const {
  detail::require_option(std::isfinite(cell_m) && cell_m > 0.0, "rays_for: cell_m", cell_m, "> 0");
  RangeSensor reduced = *this;
  const auto columns = static_cast<double>(width);
  const auto rows = static_cast<double>(height);
  // The rays of a pinhole are furthest apart at the principal point: 1 / f at unit distance.
  const bool pinhole = projection == Projection::Pinhole;
  reduced.width = detail::rays_needed((pinhole ? columns / fx : horizontal_fov_rad) * max_range_m / cell_m, width);
  reduced.height = detail::rays_needed((pinhole ? rows / fy : vertical_fov_rad) * max_range_m / cell_m, height);
  if (pinhole) {
    const double across = static_cast<double>(reduced.width) / columns;
    const double down = static_cast<double>(reduced.height) / rows;
    reduced.fx = fx * across;
    reduced.fy = fy * down;
    // The edges of the image stay where they are.
    reduced.cx = (cx + 0.5) * across - 0.5;
    reduced.cy = (cy + 0.5) * down - 0.5;
  }
  return reduced;
}

}  // namespace vantage
