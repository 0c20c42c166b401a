// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A camera of an unrectified pair.
struct LensModel {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();  ///< camera matrix: focal lengths and principal point, pixels
  /// k1, k2, p1, p2[, k3[, k4, k5, k6[, s1, s2, s3, s4[, tx, ty]]]], in OpenCV's order; empty: no distortion
  std::vector<double> distortion = {};
};

/// Calibration of an unrectified pair.
struct Rectification {
  LensModel left;                           ///< the left camera
  LensModel right;                          ///< the right camera
  Pose right_from_left = Pose::Identity();  ///< maps points in the left camera frame to the right one
};

/// A rectified stereo rig: the left pixel (u, v) and the right pixel (u - d, v) show the same point, at the depth
/// focal_px * baseline_m / (d + offset_px).
struct StereoRig {
  std::size_t width = 0;    ///< image columns; 0: not known
  std::size_t height = 0;   ///< image rows; 0: not known
  double focal_px = 0.0;    ///< focal length after rectification, pixels, > 0
  double cx = 0.0;          ///< principal point of the left image, column, pixels
  double cy = 0.0;          ///< principal point of the left image, row, pixels
  double baseline_m = 0.0;  ///< distance between the cameras, metres, > 0
  double offset_px = 0.0;   ///< column of the right principal point minus that of the left, pixels
  std::optional<Rectification> rectification = std::nullopt;  ///< nullopt: the images are already rectified

  /// Depth for a disparity, metres; infinity unless the disparity exceeds -offset_px.
  [[nodiscard]] double depth_m(double disparity_px) const;
  /// Standard deviation of the depth z, metres, for a disparity uncertainty sigma_d in pixels: z^2 sigma_d / (f b).
  [[nodiscard]] double sigma_m(double z_m, double sigma_d_px) const {
    return z_m * z_m * sigma_d_px / (focal_px * baseline_m);
  }
  /// Throws std::invalid_argument, which gives the field, its value and the valid range.
  void validate() const;
};

/// Reads a calibration file of KITTI's odometry data: one 3 x 4 projection matrix per line, with or without a name
/// ("P0:"). `left` is the number of the left camera, the next one is the right camera. Throws std::runtime_error with
/// the file and the reason.
[[nodiscard]] StereoRig read_kitti_calibration(const std::filesystem::path& file, std::size_t left = 0);

/// Reads a calibration file of Middlebury's 2014 data with lines `key=value`: `cam0=[f 0 cx; 0 f cy; 0 0 1]`,
/// `doffs`, `baseline` in millimetres, `width`, `height`; or, as in downscaled copies, `focal_px`, `cx_left`, `cy`,
/// `doffs_px`, `baseline_m`. Errors as read_kitti_calibration.
[[nodiscard]] StereoRig read_middlebury_calibration(const std::filesystem::path& file);

/// Reads calibration files written by OpenCV (YAML or XML): M1, D1, M2, D2 from `intrinsics`, and R, T (from the left
/// to the right camera) from `extrinsics`, which may be the same file. The rectified focal length and centre are
/// computed for images of width x height without blank borders, as in OpenCV's example. `unit_m` is the unit of T in
/// metres. Throws std::runtime_error with the file and the reason, and std::invalid_argument unless `unit_m` is > 0
/// and both sides are in [1, 2^26] pixels.
[[nodiscard]] StereoRig read_opencv_calibration(const std::filesystem::path& intrinsics,
                                                const std::filesystem::path& extrinsics, std::size_t width,
                                                std::size_t height, double unit_m = 1.0);

}  // namespace vantage
