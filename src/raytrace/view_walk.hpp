// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <map/sensor_frame.hpp>
#include <optional>
#include <raytrace/beam_passages.hpp>
#include <raytrace/blocking_grid.hpp>
#include <raytrace/slice_beam.hpp>
#include <raytrace/slice_flood.hpp>
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
/// All rays of a group of tiles go as one beam through all slices in which something may stop one of them, and
/// SliceFlood tells which cells of the box they may meet there: mostly none. Else the beam of each tile, between its
/// corners, is looked for such cells that no ray has met before, and its rays are walked if there are any. What rays
/// cannot meet, or have met, needs no walk: the cells that are found are those that walks of all rays find.
class ViewWalk {
 public:
  /// Of rays that may be left where they can no longer meet a cell of `box`. The grid must outlive it.
  ViewWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor, const VoxelBox& box,
           InstructionSet set);

  /// Turns to a group of tiles.
  void enter(const TileGroup& group, const TileHulls& hulls);
  /// Whether rays of the tile of this number in the group may meet a cell of the box that has not been met.
  [[nodiscard]] bool may_see(std::size_t number);
  /// Whether that is so of those rays only that meet the box, whichever are walked.
  [[nodiscard]] bool culls(std::size_t number) const {
    return (of_class_ >> number & 1U) != 0 && known_ == Known::Passages;
  }
  /// Walks `rays` of the tile of this number in the group. They do not end before they have left the box. Returns
  /// those that it leaves to others.
  [[nodiscard]] std::uint64_t walk(const RayTile& tile, std::size_t number, std::uint64_t rays, HitSink& hits);

 private:
  // Rays that advance fastest along the same axis, in the same direction.
  struct Class {
    SliceBeam all;
    SliceBeam beam;  // of those that meet the box
    ViewSlices slices;
    std::int64_t last = 0;  // slice of the box
    bool is_narrow = false;
  };
  // Where something may stop rays of a beam: in the slices [slice, next), of a layer.
  struct Stop {
    std::int64_t slice = 0;  // if larger than the last of a class: nowhere
    std::int64_t next = 0;
    LateralCells cells{};  // in which they may be there
    bool held = true;      // by the slices that tiles share
  };

  // What is known of the way of some tiles: that they meet no cell of the box; or, by passages_, which they may meet;
  // or nothing.
  enum class Known : std::uint8_t { Nothing, Passages, Free };

  [[nodiscard]] Class& class_of(const Eigen::Vector3d& direction);
  [[nodiscard]] Class made(std::size_t major, bool up) const;
  [[nodiscard]] std::uint64_t measure(const std::array<RayBlock::PerRay<float>, 3>& directions,
                                      const SliceBeam& beam);
  void spread_tiles();
  void turn_to(const Class& of, const std::array<double, 2>& least, const std::array<double, 2>& most);
  [[nodiscard]] std::uint64_t walk_mixed(const RayTile& tile, std::uint64_t rays, HitSink& hits);
  void tighten(std::uint64_t active);
  [[nodiscard]] Stop next_stop(Class& of, std::int64_t slice) const;
  [[nodiscard]] Known record(Class& of, Stop stop);
  [[nodiscard]] Known survey(std::uint64_t tiles, std::int64_t from);
  [[nodiscard]] std::uint64_t follow_recorded(std::uint64_t active, HitSink& hits);
  std::int64_t cut(const Class& of, const Stop& stop, SliceWindows& windows);
  void walk_windows(const SliceWindows& windows, std::int64_t first, std::uint64_t active, SliceHits& met);
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
  Class* of_group_ = nullptr;
  std::uint64_t of_class_ = 0;      // a bit for each of its tiles all of whose rays are of that class
  std::int64_t of_group_from_ = 0;  // slice in which something may stop their rays first
  alignas(64) std::array<std::array<double, TileHulls::kTiles>, 2> least_{};  // their lateral spread
  alignas(64) std::array<std::array<double, TileHulls::kTiles>, 2> most_{};

  // Of the part of it whose way has been looked at: all, or a quarter of the tiles, where windows hold no more.
  static constexpr std::size_t kParts = 4;
  bool fits_by_parts_ = false;  // likely
  bool by_parts_ = false;
  std::size_t part_ = kParts;
  std::int64_t from_ = 0;
  Known known_ = Known::Nothing;
  BeamPassages passages_;

  // Of the tile: the slices of the passages to be walked through, or the first stop.
  std::uint64_t to_pass_ = 0;
  Stop stop_;

  SliceBeam beam_;  // around the rays that are being walked
  SliceFlood flood_;
  SlicePlace place_;
  SliceLanes lanes_;
  SliceWindows windows_;
  alignas(64) std::array<RayBlock::PerRay<double>, 2> slope_{};  // lateral cells per cell along the major axis
};

}  // namespace vantage
