// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Geometry of a range sensor: a pinhole camera or a spherical scanner (lidar). Sensor frame: +z forward, +x right,
/// +y down. An aggregate; every class that takes one calls `validate` once.
struct RangeSensor {
  /// Mapping from pixels to ray directions.
  enum class Projection : std::uint8_t {
    Pinhole,    ///< pixel (u, v) looks along ((u - cx) / fx, (v - cy) / fy, 1)
    Spherical,  ///< equal angles: columns span the horizontal, rows the vertical field of view
  };

  static constexpr std::size_t kMostRays = std::size_t{1} << 24;  ///< limit of width x height, 4096 x 4096

  Projection projection = Projection::Pinhole;  ///< selects which of the fields below apply
  std::size_t width = 640;                      ///< columns, > 0
  std::size_t height = 480;                     ///< rows, > 0; width x height <= kMostRays
  double fx = 525.0;                            ///< horizontal focal length, pixels, in [1e-3, 1e7]; Pinhole only
  double fy = 525.0;                            ///< vertical focal length, pixels, in [1e-3, 1e7]; Pinhole only
  double cx = 319.5;                            ///< principal point, column, pixels, in [-1e6, 1e6]; Pinhole only
  double cy = 239.5;                            ///< principal point, row, pixels, in [-1e6, 1e6]; Pinhole only
  double horizontal_fov_rad = 0.0;              ///< full horizontal field of view, in [1e-4, 2 pi]; Spherical only
  /// full vertical field of view, in [1e-4, pi], centred on the horizon; Spherical only
  double vertical_fov_rad = 0.0;
  double min_range_m = 0.0;  ///< surfaces closer than this give no return, >= 0
  double max_range_m = 4.0;  ///< surfaces beyond this give no return, in (min_range_m, 10000]
  /// Whether the sensor *knows* that a ray without a return is free up to the range (time of flight, lidar). Leave it
  /// false for stereo and structured light, which cannot tell "nothing there" from "could not measure".
  bool reports_no_return = false;

  /// Creates a pinhole sensor with a centred principal point. The fields of view are full angles in radians, in (0,
  /// pi). Throws std::invalid_argument as `validate`.
  [[nodiscard]] static RangeSensor pinhole(std::size_t width, std::size_t height, double horizontal_fov_rad,
                                           double vertical_fov_rad, double min_range_m, double max_range_m);
  /// Creates a spherical sensor. The fields of view are full angles in radians. Throws std::invalid_argument as
  /// `validate`.
  [[nodiscard]] static RangeSensor spherical(std::size_t width, std::size_t height, double horizontal_fov_rad,
                                             double vertical_fov_rad, double min_range_m, double max_range_m);
  /// Returns a sensor by name: kinect, stereo, realsense, lidar, panoramic or vpl. Throws std::invalid_argument,
  /// which lists the names, for any other name.
  [[nodiscard]] static RangeSensor preset(std::string_view name);
  /// The names that `preset` accepts.
  [[nodiscard]] static const std::vector<std::string_view>& preset_names();

  /// Throws std::invalid_argument, which gives the invalid field, its value and the valid range.
  void validate() const;

  /// Unit direction, in the sensor frame, of the ray through the centre of pixel (column, row).
  [[nodiscard]] Eigen::Vector3d direction(std::size_t column, std::size_t row) const;
  /// Unit directions of all pixels in the sensor frame, row by row.
  [[nodiscard]] std::vector<Eigen::Vector3f> directions() const;
  /// Whether a direction in the sensor frame (any length) lies in the field of view. False for zero and non-finite
  /// directions.
  [[nodiscard]] bool in_view(const Eigen::Vector3d& direction) const;
  /// Full horizontal field of view, radians.
  [[nodiscard]] double horizontal_angle_rad() const;
  /// Whether the horizontal field of view is a full turn, so that turning about the vertical changes little.
  [[nodiscard]] bool looks_all_around() const;
  /// Full vertical field of view, radians.
  [[nodiscard]] double vertical_angle_rad() const;
  /// The distance, metres, up to which neighbouring rays of a row or a column are at most `cell_m` apart. Up to this
  /// distance, rays rarely miss a cell of that size; they may miss one that is rotated against the pixel rows. Not
  /// limited by the maximum range.
  [[nodiscard]] double resolving_range_m(double cell_m) const;
  /// The same sensor with fewer columns and rows: just enough that neighbouring rays are at most `cell_m` apart at
  /// the maximum range, and never more than it has. Throws std::invalid_argument unless `cell_m` is finite and > 0.
  /// (Vasquez-Gomez et al. 2013, eq. 6.)
  [[nodiscard]] RangeSensor rays_for(double cell_m) const;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/range_sensor.ipp>
#endif
