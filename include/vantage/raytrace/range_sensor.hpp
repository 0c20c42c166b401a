// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a range sensor sees: a pinhole camera, or a spherical scanner (lidar). Sensor frame: +z forward, +x right,
/// +y down. Aggregate; `validate` is called once by everything that takes one.
struct RangeSensor {
  /// How pixels become directions.
  enum class Projection : std::uint8_t {
    Pinhole,    ///< pixel (u, v) looks along ((u - cx) / fx, (v - cy) / fy, 1)
    Spherical,  ///< columns span the horizontal, rows the vertical field of view in equal angles
  };

  static constexpr std::size_t kMostRays = std::size_t{1} << 24;  ///< 4096 x 4096

  Projection projection = Projection::Pinhole;  ///< which of the fields below apply
  std::size_t width = 640;                      ///< columns, > 0
  std::size_t height = 480;                     ///< rows, > 0; width x height is at most kMostRays
  double fx = 525.0;                            ///< focal length along the rows, pixels, in [1e-3, 1e7]; Pinhole only
  double fy = 525.0;                            ///< along the columns, likewise
  double cx = 319.5;                            ///< principal point, pixels, in [-1e6, 1e6]; Pinhole only
  double cy = 239.5;                            ///< likewise
  double horizontal_fov_rad = 0.0;              ///< Spherical only, in [1e-4, 2 pi]
  double vertical_fov_rad = 0.0;                ///< Spherical only, in [1e-4, pi], centred on the horizon
  double min_range_m = 0.0;                     ///< nearer surfaces give no return, >= 0
  double max_range_m = 4.0;                     ///< further surfaces give no return, in (min_range_m, 10000]
  /// Whether a ray that meets nothing within range is *known* to be clear (time of flight, lidar). Stereo and
  /// structured light cannot tell "nothing there" from "could not see": leave it false for them.
  bool reports_no_return = false;

  /// A pinhole sensor with centred principal point and the given full angles of view, in radians.
  [[nodiscard]] static RangeSensor pinhole(std::size_t width, std::size_t height, double horizontal_fov_rad,
                                           double vertical_fov_rad, double min_range_m, double max_range_m);
  /// A spherical sensor with the given full angles of view, in radians.
  [[nodiscard]] static RangeSensor spherical(std::size_t width, std::size_t height, double horizontal_fov_rad,
                                             double vertical_fov_rad, double min_range_m, double max_range_m);
  /// A sensor by NAME: kinect, stereo, realsense, lidar, panoramic, vpl. Throws std::invalid_argument listing the
  /// names if there is no such sensor.
  [[nodiscard]] static RangeSensor preset(std::string_view name);
  /// The names `preset` knows.
  [[nodiscard]] static const std::vector<std::string_view>& preset_names();

  /// Throws std::invalid_argument naming the field, its value and the rule.
  void validate() const;

  /// Unit direction of the ray through the centre of pixel (column, row).
  [[nodiscard]] Eigen::Vector3d direction(std::size_t column, std::size_t row) const;
  /// Directions of all pixels, row by row.
  [[nodiscard]] std::vector<Eigen::Vector3f> directions() const;
  /// Whether a direction in the sensor frame (any length) falls into the field of view.
  [[nodiscard]] bool in_view(const Eigen::Vector3d& direction) const;
  /// Full angles of view, radians.
  [[nodiscard]] double horizontal_angle_rad() const;
  /// Full vertical angle of view, radians.
  [[nodiscard]] double vertical_angle_rad() const;
  /// How far from the sensor neighbouring rays are at most `cell_m` apart, metres: nearer than that hardly a cell of
  /// this size slips between them (only one turned against the rows of pixels). Not limited by the range.
  [[nodiscard]] double resolving_range_m(double cell_m) const;
  /// The same sensor with just enough columns and rows that neighbouring rays are at most `cell_m` apart at the
  /// maximum range (Vasquez-Gomez et al. 2013, eq. 6); never more than it has.
  [[nodiscard]] RangeSensor rays_for(double cell_m) const;
};

}  // namespace vantage
