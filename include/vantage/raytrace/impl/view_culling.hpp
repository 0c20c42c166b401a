// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage {

/// How many rays of a set may meet a box. Some is also the answer if the test cannot tell.
enum class Meeting : std::uint8_t { None, Some, All };

/// Culling: finds the rays of a view that can meet a box at all.
class BoxCulling {
 public:
  BoxCulling(const Pose& world_from_sensor, const Box& box, InstructionSet set);

  /// Tests all rays in a cone.
  [[nodiscard]] Meeting meeting(const RayCone& cone) const;
  /// Bit mask of the rays of a tile that may meet the box.
  [[nodiscard]] std::uint64_t meeting(const RayTile& tile) const;
  /// Upper bound on the distance from the sensor to a point of the box, metres.
  [[nodiscard]] double furthest_m() const { return furthest_m_; }

 private:
  void find_outline(const Eigen::Matrix3d& world_from_sensor);

  InstructionSet set_;
  Eigen::Vector3d origin_;
  Box box_;
  double furthest_m_ = 0.0;
  bool inside_sphere_ = false;
  std::size_t edges_ = 0;  // number of edges of the outline
  // outward normals of the planes through the origin and an edge, in the sensor frame
  std::array<Eigen::Vector3d, 6> outwards_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();  // from the sensor to the centre of the box, in the sensor frame
  double cos_ = -1.0;                                // half angle of the cone around the bounding sphere of the box
  double sin_ = 0.0;
};

/// Finds how far cones of rays from the sensor reach before a cell may stop one of the rays.
class FreeCone {
 public:
  /// The grid must outlive the object.
  FreeCone(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor);

  /// A distance, metres, up to which no cell stops a ray of the cone. The search ends soon after `enough_m`.
  [[nodiscard]] double free_m(const RayCone& cone, double enough_m);

 private:
  BlockingGrid::Reader reader_;
  double size_m_;
  Eigen::Vector3d origin_;  // in cells
  Eigen::Matrix3d world_from_sensor_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/view_culling.ipp>
#endif
