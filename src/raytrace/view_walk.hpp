// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <map/sensor_frame.hpp>
#include <optional>
#include <raytrace/blocking_grid.hpp>
#include <raytrace/slice_beam.hpp>
#include <raytrace/slice_lanes.hpp>
#include <raytrace/tile_hits.hpp>
#include <raytrace/view_slices.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage {

/// Follows the rays of a view that meet a box to the first cells that stop them: as TileWalk, but straight from their
/// directions, and through slices that all tiles share (ViewSlices). It is for rays that end nowhere near, and leaves
/// those to others that need a walk of their own.
class ViewWalk {
 public:
  /// Of rays that may be left where they can no longer meet a cell of `box`. The grid must outlive it.
  ViewWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor, const VoxelBox& box,
           InstructionSet set);

  /// Walks `rays` of a tile in a cone. Nothing stops them in the first `free_m`, and they do not end before they have
  /// left the box. Returns those that it leaves to others.
  [[nodiscard]] std::uint64_t walk(const RayTile& tile, const RayCone& cone, std::uint64_t rays, double free_m,
                                   HitSink& hits);

 private:
  // Rays that advance fastest along the same axis, in the same direction.
  struct Class {
    SliceBeam beam;  // of all that meet the box
    ViewSlices slices;
    std::int64_t last = 0;  // slice of the box
    bool is_narrow = false;
  };

  [[nodiscard]] Class& class_of(const Eigen::Vector3d& direction);
  [[nodiscard]] Class made(std::size_t major, bool up) const;
  [[nodiscard]] std::int64_t first_slice(const Class& of, const RayCone& cone, double free_m) const;
  [[nodiscard]] std::uint64_t measure(const RayTile& tile, const SlicePlace& axes);
  void tighten(std::uint64_t active);
  [[nodiscard]] std::uint64_t follow(Class& of, std::uint64_t active, std::int64_t slice, HitSink& hits);
  [[nodiscard]] std::uint64_t follow_quarters(Class& of, std::uint64_t active, std::int64_t slice, HitSink& hits);
  void place_steps(double through);
  void place_lanes(double enters);

  const BlockingGrid& grid_;
  VoxelFrame frame_;
  SensorFrame sensor_;
  Eigen::Vector3d origin_;
  VoxelBox box_;
  double distance_;  // from the origin to the box, in cells
  InstructionSet set_;
  std::array<std::optional<Class>, 6> classes_;

  SliceBeam beam_;  // around the rays that are being walked
  SlicePlace place_;
  SliceLanes lanes_;
  SliceWindows windows_;
  alignas(64) std::array<RayBlock::PerRay<double>, 2> slope_{};  // lateral cells per cell along the major axis
};

}  // namespace vantage
