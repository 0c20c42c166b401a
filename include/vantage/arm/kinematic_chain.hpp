// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/robot/capability_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Values of the joints of a chain, from the base outwards: radians, or metres where a joint slides.
using Joints = std::vector<double>;

/// A piece of a robot's body: all points within `radius_m` of a segment that is fixed to a link.
struct Capsule {
  std::size_t link = 0;                              ///< position in KinematicChain::link_poses
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();  ///< one end of the segment, in the frame of the link
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();    ///< its other end
  double radius_m = 0.0;                             ///< > 0
};

/// A joint and the link behind it after Denavit & Hartenberg (rotate about z, go along z, go along x, rotate about
/// x).
struct DhRow {
  double a_m = 0.0;        ///< along x
  double alpha_rad = 0.0;  ///< about x
  double d_m = 0.0;        ///< along z; what a sliding joint adds to
  double theta_rad = 0.0;  ///< about z; what a turning joint adds to
  JointRange range = {};   ///< of the joint
  bool slides = false;     ///< whether it slides along z instead of turning about it
};

/// How KinematicChain::inverse searches.
struct InverseOptions {
  bool free_roll = false;       ///< whether the sensor may be turned about its optical axis
  int max_iterations = 60;      ///< > 0
  double tolerance_m = 1e-6;    ///< of the position, > 0
  double tolerance_rad = 1e-6;  ///< of the orientation, > 0
};

/// Links and joints in a row from a robot's base to its sensor, and the body around them. Immutable: copies share it,
/// and any number of threads may ask.
///
///     const auto chain = KinematicChain::from_urdf("arm.urdf", "base_link", "sensor");
///     const Pose base_from_sensor = chain.sensor_pose(joints);
class KinematicChain {
 public:
  /// The chain between two links of a URDF file. The frame of `sensor_link` must be the sensor's (pose.hpp).
  /// Collision shapes of the links on the chain, and of links fixed to them, become capsules around them; a box
  /// becomes the one along its longest edge. Throws std::runtime_error naming the path if the file cannot be read or
  /// is no URDF, there is no such link or no chain between them, a joint has neither limits nor is continuous, or a
  /// shape is a mesh.
  [[nodiscard]] static KinematicChain from_urdf(const std::filesystem::path& path, std::string_view base_link,
                                                std::string_view sensor_link);
  /// The same from a text; `name` stands for the path in errors.
  [[nodiscard]] static KinematicChain from_urdf_text(const std::string& text, std::string_view base_link,
                                                     std::string_view sensor_link, const std::string& name = "URDF");
  /// A chain by its Denavit-Hartenberg parameters. Throws std::invalid_argument for no rows, an empty range, or a
  /// capsule of a link that is not there or without extent.
  [[nodiscard]] static KinematicChain from_dh(std::span<const DhRow> rows,
                                              const Pose& last_from_sensor = Pose::Identity(),
                                              std::vector<Capsule> capsules = {});

  /// How many joints move.
  [[nodiscard]] std::size_t joint_count() const;
  /// What each joint can do.
  [[nodiscard]] const std::vector<JointRange>& ranges() const;
  /// The names of the moving joints.
  [[nodiscard]] const std::vector<std::string>& joint_names() const;
  /// The body.
  [[nodiscard]] const std::vector<Capsule>& capsules() const;
  /// How many joints move the link at this position of `link_poses`: links with the same number never move against
  /// each other.
  [[nodiscard]] std::size_t joints_before(std::size_t link) const;
  /// No part of the chain, capsules included, is ever further than this from the base.
  [[nodiscard]] double reach_m() const;

  /// Whether there is a value for every joint and each is within its range.
  [[nodiscard]] bool in_range(std::span<const double> joints) const;
  /// Forward kinematics, `base_from_sensor`. Throws std::invalid_argument if there is not a value for every joint.
  [[nodiscard]] Pose sensor_pose(std::span<const double> joints) const;
  /// Where all links are, `base_from_link`: the base first, the sensor last. Throws as `sensor_pose`.
  [[nodiscard]] std::vector<Pose> link_poses(std::span<const double> joints) const;
  /// The body, piece by piece as `capsules`, but in the base's frame. Throws as `sensor_pose`.
  [[nodiscard]] std::vector<Capsule> body_at(std::span<const double> joints) const;
  /// Whether pieces of the body that two or more joints move against each other touch.
  [[nodiscard]] bool touches_itself(std::span<const Pose> base_from_links) const;
  /// The same of what `body_at` gives.
  [[nodiscard]] bool touches_itself(std::span<const Capsule> body) const;

  /// Inverse kinematics: joints within their ranges that put the sensor at this pose, searched from `guess` by damped
  /// least squares (Levenberg-Marquardt) down to the tolerances. None if the search ends elsewhere; another guess may
  /// find what this one does not. Throws std::invalid_argument for a guess of the wrong size.
  [[nodiscard]] std::optional<Joints> inverse(const Pose& base_from_sensor, std::span<const double> guess,
                                              const InverseOptions& options = {}) const;

 private:
  struct Parts;
  explicit KinematicChain(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  static void finish(Parts& parts);
  friend class UrdfReader;

  std::shared_ptr<const Parts> parts_;
};

}  // namespace vantage
