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

// Configurations drawn once, found by where they put the sensor. Everything is in the base's frame.
class Arm::Postures {
 public:
  Postures(const KinematicChain& chain, const CapabilityMapOptions& options);

  [[nodiscard]] const CapabilityMap& capability() const { return capability_; }
  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  [[nodiscard]] Joints joints(std::uint32_t posture) const;
  [[nodiscard]] Pose pose(std::uint32_t posture) const;

  // Those with the sensor in this cell of the capability map.
  [[nodiscard]] std::span<const std::uint32_t> in_cell(const VoxelIndex& cell) const;
  // At most `count` with the sensor in the cell of the pose or one beside it, those first that have least to change;
  // where `free_roll`, the turn about the optical axis does not count.
  [[nodiscard]] std::vector<std::uint32_t> near(const Pose& base_from_sensor, std::size_t count,
                                                bool free_roll) const;

 private:
  struct Drawn;
  static CapabilityMap draw(const KinematicChain& chain, const CapabilityMapOptions& options, Postures& into);
  void sort_by_cell();

  std::size_t joint_count_;
  std::vector<float> joints_;  // joint_count_ for each posture
  std::vector<Eigen::Vector3f> positions_;
  std::vector<Eigen::Quaternionf> turns_;
  CapabilityMap capability_;
  std::vector<std::uint32_t> first_in_cell_;  // of `sorted_`, for each cell of the capability map and their end
  std::vector<std::uint32_t> sorted_;
};

}  // namespace vantage
