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

/// One camera of an unrectified pair.
struct LensModel {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();  ///< focal lengths and principal point, pixels
  std::vector<double> distortion = {};              ///< k1, k2, p1, p2[, k3[, k4, k5, k6]], as OpenCV has them
};

/// What has to be done to a pair before it is rectified.
struct Rectification {
  LensModel left;                           ///< the left camera
  LensModel right;                          ///< the right camera
  Pose right_from_left = Pose::Identity();  ///< points of the left camera's frame in the right one's
};

/// A pair of cameras side by side: after rectification the left pixel (u, v) shows what the right pixel (u - d, v)
/// shows, and lies at the depth focal_px * baseline_m / (d + offset_px).
struct StereoRig {
  std::size_t width = 0;    ///< columns of the images; 0: whatever they have
  std::size_t height = 0;   ///< rows of the images; 0: whatever they have
  double focal_px = 0.0;    ///< after rectification, > 0
  double cx = 0.0;          ///< principal point of the left image, pixels
  double cy = 0.0;          ///< principal point of the left image, pixels
  double baseline_m = 0.0;  ///< distance of the cameras, metres, > 0
  double offset_px = 0.0;   ///< how much further right the right principal point is than the left one, pixels
  std::optional<Rectification> rectification = std::nullopt;  ///< none: the images are rectified already

  /// Depth of a disparity, metres; infinity where it is not above -offset_px.
  [[nodiscard]] double depth_m(double disparity_px) const;
  /// Standard deviation of the depth z for a disparity uncertain by sigma_d: z^2 sigma_d / (f b).
  [[nodiscard]] double sigma_m(double z_m, double sigma_d_px) const {
    return z_m * z_m * sigma_d_px / (focal_px * baseline_m);
  }
  /// Throws std::invalid_argument naming the field, its value and the rule.
  void validate() const;
};

/// Calibration as KITTI's odometry data have it: every row a projection matrix 3 x 4, with or without a name
/// ("P0:") before it; the first is taken for the left camera, the second for the right. Throws std::runtime_error
/// with the file and what is wrong with it.
[[nodiscard]] StereoRig read_kitti_calibration(const std::filesystem::path& file);

/// Calibration as Middlebury's 2014 pairs have it, lines `key=value`: `cam0=[f 0 cx; 0 f cy; 0 0 1]`, `doffs`,
/// `baseline` in millimetres, `width`, `height`; or, as in copies that were made smaller, `focal_px`, `cx_left`,
/// `cy`, `doffs_px`, `baseline_m`. Errors as read_kitti_calibration.
[[nodiscard]] StereoRig read_middlebury_calibration(const std::filesystem::path& file);

/// Calibration as OpenCV writes it (YAML or XML): M1, D1, M2, D2, and R, T from the left camera to the right one in
/// the same file or in `extrinsics`. The rectified focal length and centre are made for images of width x height, as
/// OpenCV's own example does, without blank borders. `unit_m`: metres per unit of T. Errors as
/// read_kitti_calibration.
[[nodiscard]] StereoRig read_opencv_calibration(const std::filesystem::path& intrinsics,
                                                const std::filesystem::path& extrinsics, std::size_t width,
                                                std::size_t height, double unit_m = 1.0);

}  // namespace vantage
