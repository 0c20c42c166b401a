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

/// How scans are aligned, and when the result is to be believed.
struct RegistrationOptions {
  double point_spacing_m = 0.02;  ///< points are thinned to about one in a cube of this edge, > 0
  double gap_m = 0.05;            ///< how near a partner must be to count as the same surface, > 0
  int iterations = 100;           ///< at most, on every level, > 0
  int levels = 6;                 ///< from coarse to fine, in [1, 8]
  double least_overlap = 0.3;     ///< share of the scan that must lie on what is known, in [0, 1]
  double most_moved_m = 0.5;      ///< a correction of the guess beyond this is not believed, metres, > 0
  double most_turned_rad = 0.35;  ///< nor is one beyond this, radians, > 0
};

/// Where a scan fits.
struct Registration {
  bool converged = false;                         ///< whether the pose is to be believed; if not, it is the guess
  std::string reason = "nothing was registered";  ///< one sentence, for a person
  Pose world_from_sensor = Pose::Identity();      ///< the scan's pose
  double overlap = 0.0;                           ///< share of its points with a partner within `gap_m`
  double rms_m = 0.0;                             ///< distance of those from the planes of their partners
  /// Of a small turn and shift of the scan in the world (rotation vector, then translation, about the scan's middle),
  /// radians and metres, from how well its points hold it: large along what slides.
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Aligns points to other points of the world (Dornhege & Kleiner 2011, IV, step 2), by OpenCV's point-to-plane ICP,
/// which goes from coarse to fine and leaves out partners that are too far off. What it finds is checked by what it
/// does not decide: how much of the scan lies on what is known, how far off its planes, and how far from the guess.
/// A scan that does not fit comes back with `converged` false, the guess, and the reason. Points that are not finite
/// are left out. Throws std::invalid_argument naming the option at fault, and if the guess is not rigid.
[[nodiscard]] Registration register_points(std::span<const Eigen::Vector3f> sensor_points,
                                           std::span<const Eigen::Vector3f> world_points, const Pose& guess,
                                           const RegistrationOptions& options = {});

/// The same with a scan (its own pose is the guess) and those taken before it.
[[nodiscard]] Registration register_scan(const Scan& scan, std::span<const Scan> before,
                                         const RegistrationOptions& options = {});

}  // namespace vantage
