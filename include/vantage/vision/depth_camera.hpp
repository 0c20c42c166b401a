// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/scan.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/vision/depth_image.hpp>

namespace VANTAGE_EXPORT vantage {

/// Uncertainty of a distance: standard deviation sigma(z) = constant + linear z + quadratic z^2, metres.
///
/// Stereo and structured light have a quadratic part, sigma_d / (f b): disparity uncertainty sigma_d in pixels, focal
/// length f in pixels, baseline b in metres. For time of flight, sigma is nearly constant.
struct DepthNoise {
  double constant_m = 0.0;       ///< >= 0
  double linear = 0.0;           ///< per metre of distance, >= 0
  double quadratic_per_m = 0.0;  ///< per square metre of distance, >= 0

  /// Standard deviation at a distance, metres.
  [[nodiscard]] double sigma_m(double z_m) const;
  /// The largest distance with at most this standard deviation, metres: 0 if there is none, infinity if sigma never
  /// exceeds it.
  [[nodiscard]] double range_for(double sigma_m) const;
};

/// A depth camera, and which of its pixels are trusted.
///
///     DepthCamera camera{.fx = 585.0, .fy = 585.0, .cx = 320.0, .cy = 240.0, .max_range_m = 4.0};
///     map.insert(depth_scan(read_depth_png("0001.png"), camera, world_from_camera).scan);
struct DepthCamera {
  std::size_t width = 640;   ///< image columns, > 0
  std::size_t height = 480;  ///< image rows, > 0
  double fx = 525.0;         ///< horizontal focal length, pixels, > 0
  double fy = 525.0;         ///< vertical focal length, pixels, not 0; negative if rows count upwards, as in ICL-NUIM
  double cx = 319.5;         ///< principal point, column, pixels
  double cy = 239.5;         ///< principal point, row, pixels
  double min_range_m = 0.0;  ///< pixels with a smaller depth are dropped, >= 0
  double max_range_m = 4.0;  ///< farther returns only clear cells up to this range, > min_range_m
  DepthNoise noise = {};     ///< uncertainty of depth
  /// Largest accepted standard deviation, metres, > 0. The range ends where `noise` exceeds it: a farther return
  /// clears cells but occupies none.
  double max_sigma_m = std::numeric_limits<double>::infinity();
  /// Threshold of the filter for flying pixels, as a share of the pixel's depth, in [0, 1). A pixel is dropped if one
  /// neighbour is nearer and the opposite one is farther, both by more than this share: it mixes an edge with its
  /// background. 0 disables the filter, min_support included.
  double edge_share = 0.03;
  /// Number of the eight neighbours, in [0, 8], that must be within `edge_share` of the pixel's depth.
  int min_support = 2;
  /// Extrinsics: the pose of the depth camera in the frame of the camera that poses refer to, if they differ.
  Pose posed_from_depth = Pose::Identity();

  /// Throws std::invalid_argument, which gives the field, its value and the valid range.
  void validate() const;
  /// The smaller of `max_range_m` and the distance at which `noise` reaches `max_sigma_m`, metres.
  [[nodiscard]] double trusted_range_m() const;
  /// The sensor model for planners. If fy is negative, the order of the rows is reversed; the rays are the same.
  /// Throws as validate.
  [[nodiscard]] RangeSensor range_sensor() const;
};

/// Statistics of the pixels of a depth image. Each pixel is counted once.
struct DepthReport {
  std::size_t used = 0;          ///< pixels used as returns
  std::size_t not_measured = 0;  ///< pixels without a measurement
  std::size_t too_near = 0;      ///< pixels nearer than DepthCamera::min_range_m
  std::size_t flying = 0;        ///< flying pixels, and pixels with too few similar neighbours
};

/// A scan made from a depth image.
struct DepthScan {
  Scan scan;           ///< organised like the image; a NaN point for every dropped pixel
  DepthReport report;  ///< pixel statistics
};

/// Converts a depth image to a scan. Dropped pixels become NaN points, which clear nothing. `world_from_posed` is the
/// pose of the camera that poses refer to. Throws std::invalid_argument if the camera is invalid or the size of the
/// image does not match.
[[nodiscard]] DepthScan depth_scan(const DepthImage& depth, const DepthCamera& camera, const Pose& world_from_posed);

}  // namespace vantage
