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

/// Joint values of a chain, from the base outwards: radians, or metres for a sliding joint.
using Joints = std::vector<double>;

/// A capsule of a robot's body: all points within `radius_m` of a segment that is fixed to a link.
struct Capsule {
  std::size_t link = 0;                              ///< index into KinematicChain::link_poses
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();  ///< start of the segment, in the frame of the link
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();    ///< end of the segment, in the frame of the link
  double radius_m = 0.0;                             ///< > 0
};

/// Denavit-Hartenberg parameters of a joint and the link behind it: rotate about z, move along z, move along x,
/// rotate about x.
struct DhRow {
  double a_m = 0.0;        ///< move along x
  double alpha_rad = 0.0;  ///< rotate about x
  double d_m = 0.0;        ///< move along z; the value of a sliding joint is added
  double theta_rad = 0.0;  ///< rotate about z; the value of a rotating joint is added
  JointRange range = {};   ///< range of the joint value
  bool slides = false;     ///< whether the joint slides along z instead of rotating about it
};

/// Tolerances and iteration limit of KinematicChain::inverse.
struct InverseOptions {
  bool free_roll = false;       ///< whether the rotation about the optical axis is free
  int max_iterations = 60;      ///< iterations before the search fails, > 0
  double tolerance_m = 1e-6;    ///< tolerance of the position, > 0
  double tolerance_rad = 1e-6;  ///< tolerance of the orientation, > 0
};

/// The chain of links and joints from the base of a robot to its sensor, and the body around them. Immutable: copies
/// share the data, and concurrent use is safe.
///
///     const auto chain = KinematicChain::from_urdf("arm.urdf", "base_link", "sensor");
///     const Pose base_from_sensor = chain.sensor_pose(joints);
class KinematicChain {
 public:
  /// Loads the chain between two links of a URDF file. The frame of `sensor_link` must be a sensor frame (pose.hpp).
  /// The collision shapes of the links on the chain, and of links fixed to them, become enclosing capsules; the
  /// capsule of a box lies along its longest edge. Throws std::runtime_error, with the path, if the file cannot be
  /// read or is not a valid URDF, a link is missing, there is no chain between the links, a joint is neither
  /// continuous nor has limits, or a shape is a mesh.
  [[nodiscard]] static KinematicChain from_urdf(const std::filesystem::path& path, std::string_view base_link,
                                                std::string_view sensor_link);
  /// Loads the chain from a URDF text. Throws as `from_urdf`; `name` replaces the path in error messages.
  [[nodiscard]] static KinematicChain from_urdf_text(const std::string& text, std::string_view base_link,
                                                     std::string_view sensor_link, const std::string& name = "URDF");
  /// Creates a chain from Denavit-Hartenberg parameters. Throws std::invalid_argument if there are no rows, a
  /// number of a row is not finite, a range has min > max, `last_from_sensor` is not rigid, or a capsule has an
  /// invalid link or radius, or an end that is not finite.
  [[nodiscard]] static KinematicChain from_dh(std::span<const DhRow> rows,
                                              const Pose& last_from_sensor = Pose::Identity(),
                                              std::vector<Capsule> capsules = {});

  /// The number of movable joints.
  [[nodiscard]] std::size_t joint_count() const;
  /// The range of each movable joint, from the base outwards.
  [[nodiscard]] const std::vector<JointRange>& ranges() const;
  /// The names of the movable joints, from the base outwards.
  [[nodiscard]] const std::vector<std::string>& joint_names() const;
  /// The body, each capsule in the frame of its link.
  [[nodiscard]] const std::vector<Capsule>& capsules() const;
  /// The number of joints between the base and the link at this index of `link_poses`. Links with equal numbers never
  /// move relative to each other. Throws std::out_of_range for an invalid index.
  [[nodiscard]] std::size_t joints_before(std::size_t link) const;
  /// Upper bound on the distance of any part of the chain, capsules included, from the base, metres.
  [[nodiscard]] double reach_m() const;

  /// Whether there is one value per joint and each is within its range.
  [[nodiscard]] bool in_range(std::span<const double> joints) const;
  /// Forward kinematics: returns `base_from_sensor`. Throws std::invalid_argument unless there is one value per
  /// joint.
  [[nodiscard]] Pose sensor_pose(std::span<const double> joints) const;
  /// The poses of all links, `base_from_link`, from the base to the sensor. Throws as `sensor_pose`.
  [[nodiscard]] std::vector<Pose> link_poses(std::span<const double> joints) const;
  /// The capsules in the frame of the base, in the order of `capsules`. Throws as `sensor_pose`.
  [[nodiscard]] std::vector<Capsule> body_at(std::span<const double> joints) const;
  /// Whether the body is in self-collision, given the poses of `link_poses`. Only pairs of capsules with at least two
  /// joints between them are tested.
  [[nodiscard]] bool touches_itself(std::span<const Pose> base_from_links) const;
  /// Whether the body is in self-collision, given the capsules of `body_at`.
  [[nodiscard]] bool touches_itself(std::span<const Capsule> body) const;

  /// Inverse kinematics: searches joint values within their ranges that bring the sensor to a pose. The search starts
  /// at `guess` and uses damped least squares (Levenberg-Marquardt). nullopt if it does not reach the tolerances, or
  /// if the pose is not rigid; another guess may succeed. Throws std::invalid_argument for a guess of the wrong size
  /// and for invalid options.
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
