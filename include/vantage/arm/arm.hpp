// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vantage/arm/kinematic_chain.hpp>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/robot/capability_map.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace vantage::detail {
class ClearSpace;
}

namespace VANTAGE_EXPORT vantage {

/// Pose of an Arm's base, boxes declared clear, and parameters of the samples and of the path search.
struct ArmOptions {
  Pose world_from_base = Pose::Identity();  ///< pose of the base, which does not move
  /// Boxes (world frame, metres) that the host knows to be clear. Unknown cells whose centre lies in one of them are
  /// not obstacles. Occupied cells always are.
  std::vector<Box> declared_clear = {};
  double margin_m = 0.0;  ///< safety margin added to the radius of the body, >= 0
  /// largest step of a joint between collision tests of a motion, > 0; metres for sliding joints
  double joint_step_rad = 0.03;
  double pose_step_rad = 0.15;  ///< largest step of a joint between poses of a path, > 0; metres for sliding joints
  std::size_t path_iterations = 1'000;  ///< iterations of RRT-Connect before a search for a path fails, > 0
  std::size_t guesses = 8;              ///< maximum number of start configurations for inverse kinematics, > 0
  /// Options of the postures that are sampled once. The capability map and the start configurations are taken from
  /// them.
  CapabilityMapOptions capability = {};
  std::uint64_t seed = 1;  ///< seed of the path search
};

/// A sensor at the end of a kinematic chain with a fixed base: a robot arm.
///
/// The body is the set of capsules of the chain. It must stay in cells that are clear (OccupancyMap::is_clear) or
/// declared clear; other unknown cells are obstacles. Capsules of the base itself are not tested. Each sensor pose
/// belongs to a unique joint configuration (see `configuration`). So if a host follows the paths of an Arm, each
/// path starts at the current joint values.
///
///     const auto chain = KinematicChain::from_urdf("arm.urdf", "base_link", "sensor");
///     const auto arm = std::make_shared<Arm>(chain, ArmOptions{.declared_clear = {around_the_robot}});
///     const auto planner = make_planner("frontier-void", {.sensor = sensor, .platform = arm});
class Arm final : public Platform {
 public:
  /// Samples the postures. Throws std::invalid_argument, which names the invalid option, or as CapabilityMap.
  explicit Arm(const KinematicChain& chain, const ArmOptions& options = {});

  /// The chain that was passed to the constructor.
  [[nodiscard]] const KinematicChain& chain() const { return chain_; }
  /// The options that were passed to the constructor.
  [[nodiscard]] const ArmOptions& options() const { return options_; }
  /// Where the sensor can be and look, estimated from the sampled postures, in the frame of the base. Postures in
  /// self-collision are excluded.
  [[nodiscard]] const CapabilityMap& capability() const;

  /// Pose of the sensor for these joint values, `world_from_sensor`. Throws std::invalid_argument if the number of
  /// values is wrong.
  [[nodiscard]] Pose sensor_pose(std::span<const double> joints) const;
  /// The joint configuration that belongs to a pose. Inverse kinematics starts from sampled postures near the pose,
  /// the nearest first, and the first solution within the joint ranges and without self-collision is returned.
  /// nullopt if there is none.
  [[nodiscard]] std::optional<Joints> configuration(const Pose& world_from_sensor) const;
  /// Whether the joint values are within their ranges, and the body touches neither itself nor any cell that is not
  /// clear.
  [[nodiscard]] bool admits_joints(const OccupancyMap& map, std::span<const double> joints) const;
  /// A path in joint space from the configuration of `from` to that of `to`, both included, as a polyline that is
  /// collision-free everywhere. Cells that the body already touches at `from` are not obstacles. It is the straight
  /// line if possible, otherwise the result of RRT-Connect (OMPL) after shortcutting. nullopt if no path is found.
  /// Deterministic for equal inputs.
  [[nodiscard]] std::optional<std::vector<Joints>> joint_path(const OccupancyMap& map, const Pose& from,
                                                              const Pose& to) const;
  /// The poses of all sampled postures that are free of collisions in the map: a dense sample, for exhaustive
  /// searches.
  [[nodiscard]] std::vector<Pose> admitted_poses(const OccupancyMap& map) const;

  /// Whether the configuration of the pose exists and is free of collisions.
  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override;
  /// Whether the cell is clear, and a sampled posture with the sensor in the same cell of the capability map is free
  /// of collisions. This is a fast approximation with the resolution of the capability map; use `admits` for the
  /// exact answer.
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override;
  [[nodiscard]] VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const override;
  /// Whether the joints can move on a straight line from the configuration of `from` to that of `to`. If `to` has no
  /// configuration, a rotation of the sensor about its optical axis is allowed at the end.
  [[nodiscard]] bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override;
  /// A pose at `position_m` that looks along `direction`, with the roll that the arm can reach. If the arm cannot do
  /// this, it looks along the direction of the nearest sampled posture that the arm can reach at this position. If
  /// the arm cannot reach the position at all, the pose looks along `direction` without roll.
  [[nodiscard]] Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const override;
  /// Straight-line distance between the positions, metres: a lower bound on the length of the sensor's path.
  [[nodiscard]] double distance_m(const Pose& from, const Pose& to) const override;
  /// Poses along `joint_path`, with at most `pose_step_rad` between them in each joint.
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override;
  /// A cube around the sensor, metres, world: half its edge is the radius of the largest ball around the sensor
  /// inside a capsule behind the last joint. The host must declare the free space for the rest of the arm.
  [[nodiscard]] Box body_box(const Pose& pose) const override;
  [[nodiscard]] bool can_tilt() const override { return true; }

 private:
  class Postures;
  class Memory;
  [[nodiscard]] VoxelGrid<std::uint8_t> passable_cells(const OccupancyMap& map) const;
  [[nodiscard]] std::shared_ptr<const detail::ClearSpace> clear_space(const OccupancyMap& map) const;
  [[nodiscard]] std::shared_ptr<const detail::ClearSpace> clear_space_from(const OccupancyMap& map,
                                                                           const Joints& first) const;
  [[nodiscard]] std::optional<VoxelIndex> obstacle(const detail::ClearSpace& space,
                                                   std::span<const Capsule> body) const;
  [[nodiscard]] bool keeps_to(const detail::ClearSpace& space, std::span<const double> joints) const;
  [[nodiscard]] bool moves_in(const detail::ClearSpace& space, const Joints& from, const Joints& to) const;

  KinematicChain chain_;
  ArmOptions options_;
  std::shared_ptr<const Postures> postures_;
  std::shared_ptr<Memory> memory_;  // caches results; does not change them
};

}  // namespace vantage
