// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Parameters of the alignment, and limits for accepting its result.
struct RegistrationOptions {
  double point_spacing_m = 0.02;  ///< points are thinned to one per cube of this edge, > 0
  double gap_m = 0.05;            ///< largest distance to a corresponding point of the same surface, > 0
  int iterations = 100;           ///< maximum number of iterations per level, > 0
  int levels = 6;                 ///< number of levels from coarse to fine, in [1, 8]
  double least_overlap = 0.3;     ///< smallest accepted share of scan points that have a correspondence, in [0, 1]
  double most_moved_m = 0.5;      ///< largest accepted translation from the guess, metres, > 0
  double most_turned_rad = 0.35;  ///< largest accepted rotation from the guess, radians, > 0
};

/// Result of a registration.
struct Registration {
  bool converged = false;                         ///< whether the result is accepted; if not, the pose is the guess
  std::string reason = "nothing was registered";  ///< one sentence for the user
  Pose world_from_sensor = Pose::Identity();      ///< pose of the scan
  double overlap = 0.0;                           ///< share of scan points with a correspondence within `gap_m`
  double rms_m = 0.0;  ///< RMS distance of these points from the planes of their correspondences
  /// Covariance of a small rotation (rotation vector, radians) and translation (metres) of the scan in the world,
  /// about the centroid of the scan. Directions in which the scan can slide have a large variance.
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Aligns points in the sensor frame with points in the world frame by OpenCV's point-to-plane ICP, which works from
/// coarse to fine and rejects outliers. The result is then checked: overlap with known points, and distance from the
/// guess. If a check fails, the result has `converged` false, the guess as pose, and the reason. Points that are not
/// finite are ignored. Throws std::invalid_argument if an option is invalid, which it names, or if the guess is not
/// rigid. (Dornhege & Kleiner 2011, IV, step 2.)
[[nodiscard]] Registration register_points(std::span<const Eigen::Vector3f> sensor_points,
                                           std::span<const Eigen::Vector3f> world_points, const Pose& guess,
                                           const RegistrationOptions& options = {});

/// Aligns a scan with earlier scans; the pose of the scan is the guess. Returns beyond the range of a scan are
/// ignored. Errors as register_points.
[[nodiscard]] Registration register_scan(const Scan& scan, std::span<const Scan> before,
                                         const RegistrationOptions& options = {});

}  // namespace vantage
