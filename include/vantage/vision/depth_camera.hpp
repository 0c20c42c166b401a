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

/// How uncertain a distance is: sigma(z) = constant + linear z + quadratic z^2, one standard deviation, metres.
///
/// Stereo and structured light have a quadratic part, sigma_d / (f b) with a disparity uncertain by sigma_d pixels, a
/// focal length of f pixels and a baseline of b metres; time of flight is nearly constant.
struct DepthNoise {
  double constant_m = 0.0;       ///< >= 0
  double linear = 0.0;           ///< per metre of distance, >= 0
  double quadratic_per_m = 0.0;  ///< per square metre of distance, >= 0

  /// Standard deviation at a distance, metres.
  [[nodiscard]] double sigma_m(double z_m) const;
  /// The largest distance with at most this standard deviation, metres: 0 if there is none, infinity if all have.
  [[nodiscard]] double range_for(double sigma_m) const;
};

/// A camera of depth images, and which of its pixels are to be believed.
///
///     DepthCamera camera{.fx = 585.0, .fy = 585.0, .cx = 320.0, .cy = 240.0, .max_range_m = 4.0};
///     map.insert(depth_scan(read_depth_png("0001.png"), camera, world_from_camera).scan);
struct DepthCamera {
  std::size_t width = 640;   ///< columns of its images, > 0
  std::size_t height = 480;  ///< rows of its images, > 0
  double fx = 525.0;         ///< focal length along the rows, pixels, > 0
  double fy = 525.0;         ///< along the columns, not 0; negative, as in ICL-NUIM, where rows count upwards
  double cx = 319.5;         ///< principal point, pixels
  double cy = 239.5;         ///< principal point, pixels
  double min_range_m = 0.0;  ///< what is nearer along the axis is dropped, >= 0
  double max_range_m = 4.0;  ///< returns further than this only clear up to it, > min_range_m
  DepthNoise noise = {};     ///< how uncertain distances are
  /// Where `noise` exceeds this the range ends, metres, > 0: an uncertain return clears but does not occupy.
  double max_sigma_m = std::numeric_limits<double>::infinity();
  /// A pixel between a neighbour that is nearer and an opposite one that is further, both by more than this share of
  /// its distance, hangs in the air between an edge and what is behind it ("flying") and is dropped. 0: none is.
  double edge_share = 0.03;
  /// Of the eight neighbours so many must be within `edge_share` of the pixel's distance, in [0, 8]; 0: none need be.
  int min_support = 2;
  /// Depth-to-colour extrinsics: the depth camera in the frame that poses speak of, if that is another camera's.
  Pose posed_from_depth = Pose::Identity();

  /// Throws std::invalid_argument naming the field, its value and the rule.
  void validate() const;
  /// The shorter of `max_range_m` and where `noise` reaches `max_sigma_m`, metres.
  [[nodiscard]] double trusted_range_m() const;
  /// What planners need to know of it. Rows are in the order that makes fy positive: the same rays. Throws as
  /// validate, and if the trusted range is not above `min_range_m`.
  [[nodiscard]] RangeSensor range_sensor() const;
};

/// What became of the pixels of a depth image: each is counted once.
struct DepthReport {
  std::size_t used = 0;          ///< returns of the scan
  std::size_t not_measured = 0;  ///< the image has nothing there
  std::size_t too_near = 0;      ///< nearer than DepthCamera::min_range_m
  std::size_t flying = 0;        ///< beside an edge, or without support
};

/// A scan and where its points come from.
struct DepthScan {
  Scan scan;           ///< organised as the image, a NaN point for every pixel not used
  DepthReport report;  ///< the pixels by what became of them
};

/// Turns a depth image into a scan. Pixels that are dropped become NaN points: they free nothing. Throws
/// std::invalid_argument naming what is wrong with the camera, or with the size of the image.
[[nodiscard]] DepthScan depth_scan(const DepthImage& depth, const DepthCamera& camera, const Pose& world_from_posed);

}  // namespace vantage
