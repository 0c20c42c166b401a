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
///
/// All rays of a group of tiles go as one beam to where something may stop one of them, each tile goes on as a beam,
/// between its corners, and what its rays are is not asked for until something may stop one.
class ViewWalk {
 public:
  /// Of rays that may be left where they can no longer meet a cell of `box`. The grid must outlive it.
  ViewWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor, const VoxelBox& box,
           InstructionSet set);

  /// Turns to a group of tiles. Nothing stops its rays in the first `free_m`.
  void enter(const TileGroup& group, const TileHulls& hulls, double free_m);
  /// Walks `rays` of the tile of this number in the group. They do not end before they have left the box. Returns
  /// those that it leaves to others.
  [[nodiscard]] std::uint64_t walk(const RayTile& tile, std::size_t number, std::uint64_t rays, HitSink& hits);

 private:
  // Rays that advance fastest along the same axis, in the same direction.
  struct Class {
    SliceBeam beam;  // of all that meet the box
    ViewSlices slices;
    std::int64_t last = 0;  // slice of the box
    bool is_narrow = false;
  };
  // Least and largest lateral cells per cell along the major axis.
  struct Spread {
    std::array<double, 2> least;
    std::array<double, 2> most;
  };
  static constexpr Spread kAllOfClass{{-1.0, -1.0}, {1.0, 1.0}};
  // Where something may stop rays of a beam: in the slices [slice, next), of a layer.
  struct Stop {
    std::int64_t slice = 0;  // if larger than the last of a class: nowhere
    std::int64_t next = 0;
    LateralCells cells{};  // in which they may be there
    bool held = true;      // by the slices that tiles share
  };

  [[nodiscard]] Class& class_of(const Eigen::Vector3d& direction);
  [[nodiscard]] Class made(std::size_t major, bool up) const;
  [[nodiscard]] std::int64_t first_slice(const Class& of, const RayCone& cone, double free_m) const;
  [[nodiscard]] std::uint64_t measure(const std::array<RayBlock::PerRay<float>, 3>& directions,
                                      const SlicePlace& axes, const Spread& spread);
  void spread_tiles();
  void turn_to(const Class& of, const std::array<double, 2>& least, const std::array<double, 2>& most);
  [[nodiscard]] std::uint64_t walk_mixed(const RayTile& tile, std::uint64_t rays, HitSink& hits);
  void tighten(std::uint64_t active);
  [[nodiscard]] Stop next_stop(Class& of, std::int64_t slice) const;
  [[nodiscard]] std::uint64_t follow(Class& of, std::uint64_t active, Stop stop, HitSink& hits);
  [[nodiscard]] std::uint64_t follow_quarters(Class& of, std::uint64_t active, std::int64_t slice, HitSink& hits);
  void place_steps(double through);
  void place_lanes(double enters);

  const BlockingGrid& grid_;
  VoxelFrame frame_;
  SensorFrame sensor_;
  Eigen::Vector3d origin_;
  VoxelBox box_;
  InstructionSet set_;
  std::array<std::optional<Class>, 6> classes_;

  // Of the group of tiles.
  RayCone cone_;
  double free_m_ = 0.0;
  Class* of_group_ = nullptr;
  std::uint64_t of_class_ = 0;  // a bit for each of its tiles all of whose rays are of that class
  std::int64_t from_ = 0;       // slice in which something may stop their rays first
  alignas(64) std::array<std::array<double, TileHulls::kTiles>, 2> least_{};  // their lateral spread
  alignas(64) std::array<std::array<double, TileHulls::kTiles>, 2> most_{};

  SliceBeam beam_;  // around the rays that are being walked
  SlicePlace place_;
  SliceLanes lanes_;
  SliceWindows windows_;
  alignas(64) std::array<RayBlock::PerRay<double>, 2> slope_{};  // lateral cells per cell along the major axis
};

}  // namespace vantage
