// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map/instruction_set.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage {

/// Which of some rays may meet a box: none, or some, or all as far as is known.
enum class Meeting : std::uint8_t { None, Some, All };

/// Which rays of a view can meet a box at all.
class BoxCulling {
 public:
  BoxCulling(const Pose& world_from_sensor, const Box& box, InstructionSet set);

  /// Of the rays of a cone.
  [[nodiscard]] Meeting meeting(const RayCone& cone) const;
  /// The rays of a tile that may pass through the box.
  [[nodiscard]] std::uint64_t meeting(const RayTile& tile) const;
  /// No point of the box is further from the sensor than this, metres.
  [[nodiscard]] double furthest_m() const { return furthest_m_; }

 private:
  void find_outline(const Eigen::Matrix3d& world_from_sensor);

  InstructionSet set_;
  Eigen::Vector3d origin_;
  Box box_;
  double furthest_m_ = 0.0;
  bool inside_sphere_ = false;
  std::size_t edges_ = 0;                            // of the outline
  std::array<Eigen::Vector3d, 6> outwards_;          // across planes through them and the origin, in the sensor frame
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();  // to the centre of the box, in the sensor frame
  double cos_ = -1.0;                                // of the cone around the box
  double sin_ = 0.0;
};

}  // namespace vantage
