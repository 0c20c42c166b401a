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

/// Where an Arm stands and how it moves.
struct ArmOptions {
  Pose world_from_base = Pose::Identity();  ///< where the base stands; it does not move
  /// Unknown cells whose centres lie in one of these boxes (metres, world) do not stand in the way: what the host
  /// knows to be clear. What the map knows to be occupied does, everywhere.
  std::vector<Box> declared_clear = {};
  double margin_m = 0.0;         ///< the body is thought this much thicker, >= 0
  double joint_step_rad = 0.03;  ///< a motion is tested at configurations at most so far apart in each joint, > 0
  double pose_step_rad = 0.15;   ///< poses of a path are at most so far apart in each joint, > 0
  std::size_t path_iterations = 1'000;  ///< of RRT-Connect before a path is given up, > 0
  std::size_t guesses = 8;              ///< configurations that inverse kinematics starts from at most, > 0
  /// Of the postures drawn once, which the capability map and the guesses come from.
  CapabilityMapOptions capability = {};
  std::uint64_t seed = 1;  ///< of the search for paths
};

/// A sensor at the end of a kinematic chain whose base stands still: a robot's arm.
///
/// Its body, the capsules of the chain, must keep to cells that are clear (OccupancyMap::is_clear) or declared so;
/// unknown ones are obstacles. Capsules of the base itself are exempt: it stands where it stands. A pose of the
/// sensor stands for one configuration of the joints, always the same (`configuration`): so a host that follows the
/// paths of an Arm has its joints where the next path begins.
///
///     const auto chain = KinematicChain::from_urdf("arm.urdf", "base_link", "sensor");
///     const auto arm = std::make_shared<Arm>(chain, ArmOptions{.declared_clear = {around_the_robot}});
///     const auto planner = make_planner("frontier-void", {.sensor = sensor, .platform = arm});
class Arm final : public Platform {
 public:
  /// Draws the postures. Throws std::invalid_argument naming the option at fault, or as CapabilityMap.
  explicit Arm(const KinematicChain& chain, const ArmOptions& options = {});

  /// The links and joints.
  [[nodiscard]] const KinematicChain& chain() const { return chain_; }
  /// The options it was made with.
  [[nodiscard]] const ArmOptions& options() const { return options_; }
  /// Where the sensor can be and look, by what was drawn, in the base's frame; self-collisions left out.
  [[nodiscard]] const CapabilityMap& capability() const;

  /// The pose of the sensor at these joints, `world_from_sensor`. Throws std::invalid_argument for a wrong number.
  [[nodiscard]] Pose sensor_pose(std::span<const double> joints) const;
  /// The configuration that a pose stands for: the first that inverse kinematics reaches, within the joints' ranges
  /// and not touching itself, from drawn postures near the pose, the nearest first. None if there is none.
  [[nodiscard]] std::optional<Joints> configuration(const Pose& world_from_sensor) const;
  /// Whether the body, at these joints, is in their ranges, does not touch itself, and touches clear cells only.
  [[nodiscard]] bool admits_joints(const OccupancyMap& map, std::span<const double> joints) const;
  /// The way of the joints from the configuration of one pose to that of the other, both included: straight from each
  /// to the next, and admitted all the way, but for cells that the body touches at `from` already. The straight way
  /// if that is admitted, else what RRT-Connect (OMPL) finds and shortcuts leave of it. The same input gives the same
  /// way.
  [[nodiscard]] std::optional<std::vector<Joints>> joint_path(const OccupancyMap& map, const Pose& from,
                                                              const Pose& to) const;
  /// The poses of all drawn postures that the map admits: as good as everywhere, for searches that leave nothing out.
  [[nodiscard]] std::vector<Pose> admitted_poses(const OccupancyMap& map) const;

  /// Whether the configuration of the pose is admitted.
  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override;
  /// Whether the cell is clear and the map admits a drawn posture with the sensor in the same cell of the capability
  /// map: quick, and right but for the size of such a cell. `admits` has the last word.
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override;
  [[nodiscard]] VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const override;
  /// Whether the joints may go straight from the configuration of one pose to that of the other or, where it has
  /// none, to one that brings the sensor there but for its turn about the optical axis.
  [[nodiscard]] bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override;
  /// The pose there that looks along `direction`, turned about it as the arm can; else along the nearest direction of
  /// the drawn postures that it can look along there; without roll where it cannot be at all.
  [[nodiscard]] Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const override;
  /// The straight distance: the least the sensor must move.
  [[nodiscard]] double distance_m(const Pose& from, const Pose& to) const override;
  /// The poses along `joint_path`, near enough to each other to follow.
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override;
  /// A cube about the sensor: around the largest ball there that is all body of the last link. What the rest of the
  /// arm needs free, a host declares.
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
  std::shared_ptr<Memory> memory_;  // tells sooner what would be told without
};

}  // namespace vantage
