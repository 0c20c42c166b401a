// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vantage/arm/arm.hpp>
#include <vantage/robot/capability_map.hpp>
#include <vector>

namespace vantage {

// Configurations that are sampled once and indexed by the position of the sensor. Everything is in the frame of the
// base.
class Arm::Postures {
 public:
  Postures(const KinematicChain& chain, const CapabilityMapOptions& options);

  [[nodiscard]] const CapabilityMap& capability() const { return capability_; }
  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  [[nodiscard]] Joints joints(std::uint32_t posture) const;
  [[nodiscard]] Pose pose(std::uint32_t posture) const;

  // The postures with the sensor in this cell of the capability map.
  [[nodiscard]] std::span<const std::uint32_t> in_cell(const VoxelIndex& cell) const;
  // Up to `count` postures with the sensor in the cell of the pose or next to it, most similar first. With
  // `free_roll`, the rotation about the optical axis is ignored.
  [[nodiscard]] std::vector<std::uint32_t> near(const Pose& base_from_sensor, std::size_t count,
                                                bool free_roll) const;

 private:
  struct Drawn;
  static CapabilityMap draw(const KinematicChain& chain, const CapabilityMapOptions& options, Postures& into);
  void sort_by_cell();

  std::size_t joint_count_;
  std::vector<float> joints_;  // joint_count_ values per posture
  std::vector<Eigen::Vector3f> positions_;
  std::vector<Eigen::Quaternionf> turns_;
  CapabilityMap capability_;
  // start of each capability cell's range in `sorted_`, and the end of the last
  std::vector<std::uint32_t> first_in_cell_;
  std::vector<std::uint32_t> sorted_;
};

}  // namespace vantage
