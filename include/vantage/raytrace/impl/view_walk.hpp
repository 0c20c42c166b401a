// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/impl/sensor_frame.hpp>
#include <vantage/raytrace/impl/beam_passages.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/impl/slice_flood.hpp>
#include <vantage/raytrace/impl/slice_walk.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage::detail {

/// Finds the cells of a box that stop the rays of a view, for all tiles together. It is the fast path of
/// RayCaster::visible_cells for rays that do not end before the box. The rays that it does not resolve are left to
/// SliceWalk::cast.
///
/// Idea. For each group of tiles, one beam around all its rays is followed through the slices, and a flood finds
/// which cells of the box the rays may meet. Often there is none, and the group is done. Otherwise the beam of each
/// tile is tested for such cells that no ray has met yet, and its rays are walked only if there are any. Rays that
/// meet no cell, or only cells found before, need no walk. So the result is that of walking all rays. (Glossary in
/// slices.hpp.)
class ViewWalk {
 public:
  /// For views from this pose that look for cells of `box`. The walk, from the same origin, must outlive the object.
  ViewWalk(SliceWalk& walk, const Pose& world_from_sensor, const VoxelBox& box, InstructionSet set);

  /// Starts a group of tiles. Returns false if none of its rays meets a cell of the box.
  [[nodiscard]] bool enter(const TileGroup& group, const TileHulls& hulls);
  /// What is known of the way of some tiles. Nothing: their rays may belong to several classes. FirstStop: where a
  /// cell may stop one of the rays. Passages: which cells of the box they may meet. Free: they meet none.
  enum class Known : std::uint8_t { Nothing, FirstStop, Passages, Free };
  /// What the survey of a group tells about a tile.
  struct Outlook {
    Known known = Known::Nothing;
    SliceBeam beam;            ///< bounds the rays that may meet the box
    std::uint64_t slices = 0;  ///< slices of the passages to walk
    Stop stop;                 ///< the first stop, if there are no passages
  };
  /// Looks at a tile, given by its index in the group. Returns whether its rays may meet a cell of the box that no
  /// ray has met yet; only then `outlook` is complete.
  [[nodiscard]] bool look(std::size_t number, Outlook& outlook);
  /// Walks the selected `rays` of a tile with this outlook. With passages, they may include rays that miss the box.
  /// The rays must not end before they have left the box. Returns the rays that must be walked otherwise.
  [[nodiscard]] std::uint64_t walk(const RayTile& tile, const Outlook& outlook, std::uint64_t rays, HitSink& hits);

 private:
  // A class of rays.
  struct Class {
    SliceBeam beam;          // bounds the rays that may meet the box
    std::int64_t last = 0;   // the last slice of the box
    std::int64_t from = -1;  // no cell stops a ray before this slice; -1: not known yet
  };

  [[nodiscard]] std::uint64_t measure(const std::array<RayBlock::PerRay<float>, 3>& directions,
                                      const SliceBeam& beam);
  void spread_tiles();
  static void narrow(SliceBeam& beam, const std::array<double, 2>& least, const std::array<double, 2>& most);
  void survey(std::uint64_t tiles, std::int64_t from);
  [[nodiscard]] Known record(const SliceBeam& beam, Stop stop);
  [[nodiscard]] std::uint64_t walk_recorded(const Outlook& outlook, std::uint64_t active, HitSink& hits);

  SliceWalk& walk_;
  SensorFrame sensor_;
  InstructionSet set_;
  std::array<Class, 6> classes_;

  // State of the group of tiles.
  Class* of_group_ = nullptr;       // the class of its axis
  std::uint64_t of_class_ = 0;      // bit mask of the tiles whose rays all belong to that class
  std::int64_t of_group_from_ = 0;  // first slice in which a cell may stop their rays
  alignas(64) std::array<std::array<double, TileHulls::kTiles>, 2> least_{};  // ranges of slopes of the tiles
  alignas(64) std::array<std::array<double, TileHulls::kTiles>, 2> most_{};

  // State of the part of the group that was surveyed: the whole group, or a quarter of it where its windows would be
  // too small.
  std::uint64_t surveyed_ = 0;  // bit mask of its tiles
  bool fits_by_parts_ = false;  // whether the windows of quarters may be large enough
  std::int64_t from_ = 0;       // first slice in which a cell may stop its rays
  Known known_ = Known::Nothing;
  BeamPassages passages_;

  SliceFlood flood_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/view_walk.ipp>
#endif
