// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/single_walk.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>
#include <vantage/raytrace/impl/slices.hpp>
#include <vantage/raytrace/impl/tile_hits.hpp>

namespace vantage::detail {

/// The walk of the rays of a tile through the slices around their origin, class by class: as one beam through free
/// layers, and as lanes where a cell may stop them. Single rays are walked exactly (SingleWalk) if they spread too
/// far, or pass too close to an edge between cells. The resulting cells equal those of VoxelRay for every instruction
/// set.
class SliceWalk {
 public:
  static constexpr int kFewRays = 4;  ///< fewer rays are better walked one by one

  /// For rays from `origin`. The grid must outlive the object.
  SliceWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin, InstructionSet set);

  /// Walks the selected `rays` of a block to the first cells that stop them. Their ends must be placed. Hits outside
  /// `within` may be missing. No cell may stop a ray within the first `free_share` of its length, in [0, 1].
  void cast(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, double free_share, HitSink& hits);
  /// Follows the `active` rays, which lie inside `beam`, from this stop on to the cells that stop them, and up to
  /// slice `last`. Returns the rays that must be walked otherwise: doubtful ones, and those that spread too far.
  [[nodiscard]] std::uint64_t follow(SliceBeam beam, Stop stop, std::int64_t last, std::uint64_t active,
                                     HitSink& hits);
  /// Prepares `walk` for the current lines; `follow` does so itself.
  void start() { place_steps(1.0); }
  /// Walks the `active` rays through the windows; the ends of the rays are ignored.
  void walk(const SliceBeam& beam, const SliceWindows& windows, std::uint64_t active, SliceHits& met);

  /// All rays of each class.
  std::array<SliceBeam, 6> beams;
  /// What the rays pass.
  Slices slices;
  /// The rays. The walk starts with the slopes set.
  RayLines lines;
  /// The smallest length of a ray, if rays may end before the last slice.
  double shortest = std::numeric_limits<double>::infinity();

 private:
  [[nodiscard]] RayBlock::PerRay<std::int32_t> classes_of(const RayExtents& extents) const;
  [[nodiscard]] std::uint64_t cast_class(SliceBeam beam, const RayExtents& extents, std::uint64_t rays,
                                         const VoxelBox& within, double free_share, HitSink& hits);
  void place_steps(double through);
  void place_lanes(const SliceBeam& beam, const SlicePlace& place, double enters);
  [[nodiscard]] std::uint64_t ending_by(double distance) const;
  void end_rays(std::uint64_t ending, double to_first, SliceHits& met) const;

  // Clamps a value to [least, most]; NaN becomes `least`. The limits are members of the walk: with limits that are
  // compile-time constants g++ 12 turns the minimum and the maximum into masks, which takes twice as long.
  struct Clamp {
    double least;
    double most;

    [[nodiscard]] double operator()(double value) const {
      const double no_less = value > least ? value : least;
      return no_less < most ? no_less : most;
    }
  };

  const BlockingGrid& grid_;
  VoxelFrame frame_;
  Eigen::Vector3d origin_;
  InstructionSet set_;
  Clamp steps_{-1.0 * SliceLanes::kCell, 1.0 * SliceLanes::kCell};
  Clamp places_{-1.0 * SliceLanes::kCell, 1.0 * SliceWindows::kWidth* SliceLanes::kCell};
  SliceLanes lanes_;
  SliceWindows windows_;
};

inline SliceWalk::SliceWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin,
                            InstructionSet set)
    : slices(grid, set), grid_(grid), frame_(frame), origin_(origin), set_(set) {
  for (std::int32_t number = 0; SliceBeam & of_class : beams) {
    of_class = SliceBeam(frame, origin, number++);
  }
}

inline void SliceWalk::cast(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, double free_share,
                            HitSink& hits) {
  RayExtents extents;
  measure(block, origin_, frame_.size_m, extents, set_);
  const RayBlock::PerRay<std::int32_t> classes = classes_of(extents);
  std::uint64_t singly = 0;  // rays that need an exact walk
  while (rays != 0) {
    const std::int32_t chosen = classes[static_cast<std::size_t>(std::countr_zero(rays))];
    const std::uint64_t of_class = equal_to(classes, chosen, set_) & rays;
    rays &= ~of_class;
    singly |= std::popcount(of_class) < SliceWalk::kFewRays
                  ? of_class
                  : cast_class(beams[static_cast<std::size_t>(chosen)], extents, of_class, within, free_share, hits);
  }
  for (; singly != 0; singly &= singly - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(singly));
    const Eigen::Vector3d end(block.end[0][i], block.end[1][i], block.end[2][i]);
    SingleWalk walk(frame_, origin_, frame_.cell_of(origin_), end, frame_.cell_of(end));
    if (walk.advance(grid_)) {
      hits.take(i, walk.cell());
    }
  }
}

inline RayBlock::PerRay<std::int32_t> SliceWalk::classes_of(const RayExtents& extents) const {
  RayBlock::PerRay<std::int32_t> classes;
  compiled_for(set_, [x = extents[0].data(), y = extents[1].data(), z = extents[2].data(), of = classes.data()] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      of[i] = class_of_ray(x[i], y[i], z[i]);
    }
  });
  return classes;
}

// Walks the rays of a class. Returns those that need an exact walk.
inline std::uint64_t SliceWalk::cast_class(SliceBeam beam, const RayExtents& extents, std::uint64_t rays,
                                           const VoxelBox& within, double free_share, HitSink& hits) {
  lines.place(extents, beam.axes, set_);
  const auto [least, longest] = range_of(lines.length, rays, set_);
  // A ray without a length has no slopes.
  if (!(least > SliceBeam::kRounding)) {
    return rays;
  }
  shortest = least;
  beam.tighten(lines, rays, set_);
  // The last slice in which a ray may meet a cell of interest.
  const std::int64_t last = std::min(beam.last_slice_of(within),
                                     static_cast<std::int64_t>(longest + beam.from_entry + SliceBeam::kRounding));
  const double free_cells = free_share * least - SliceBeam::kRounding;
  const auto first = free_cells > 0.0 ? static_cast<std::int64_t>(std::max(free_cells + beam.from_entry, 0.0)) : 0;
  return follow(beam, slices.next_stop(beam, first, last), last, rays, hits);
}

inline std::uint64_t SliceWalk::follow(SliceBeam beam, Stop stop, std::int64_t last, std::uint64_t active,
                                       HitSink& hits) {
  std::uint64_t others = 0;
  start();
  for (; active != 0 && stop.slice <= last; stop = slices.next_stop(beam, stop.next, last)) {
    if (!stop.fits_windows()) {
      // The beam is wider than a window. Each quarter of the tile, 4 x 4 neighbouring rays, goes on with a narrower
      // beam of its own.
      for (unsigned quarter = 0; quarter < 4; ++quarter) {
        const std::uint64_t some = active & std::uint64_t{0xFFFF} << 16U * quarter;
        if (some == active) {
          return others | active;
        }
        if (some != 0) {
          beam.tighten(lines, some, set_);
          others |= follow(beam, slices.next_stop(beam, stop.slice, last), last, some, hits);
        }
      }
      return others;
    }
    slices.cut(beam, stop, windows_);
    if (windows_.count == 0) {
      continue;
    }
    const std::uint64_t before = active;
    std::uint64_t ending = 0;
    // Rays that end before the windows meet no more cells. Those that may end inside are walked as the others;
    // end_rays then checks their hits.
    const double leaves = beam.entered_at(windows_.first + static_cast<std::int64_t>(windows_.count));
    if (shortest <= leaves + SliceBeam::kRounding) {
      active &= ~ending_by(beam.entered_at(windows_.first) - SliceBeam::kRounding);
      ending = active & ending_by(leaves + SliceBeam::kRounding);
    }
    SliceHits met;
    met.where.fill(-1);
    walk(beam, windows_, active, met);
    end_rays(ending, beam.from_entry - static_cast<double>(windows_.first), met);
    if (met.stopped != 0) {
      hits.take(met, windows_.place);
    }
    others |= met.doubtful;
    active &= ~(met.stopped | met.doubtful | ending);
    // A beam around fewer rays may be narrower, and then has fewer stops.
    if (active != before && active != 0) {
      beam.tighten(lines, active, set_);
    }
  }
  return others;
}

static_assert(SliceBeam::kRounding * SliceLanes::kCell + 10 < SliceLanes::kDoubt);

inline void SliceWalk::walk(const SliceBeam& beam, const SliceWindows& windows, std::uint64_t active,
                            SliceHits& met) {
  place_lanes(beam, windows.place, beam.entered_at(windows.first));
  if (windows.first == 0) {  // rays start inside slice 0, so they pass only a part of it
    place_steps(beam.entered_at(1));
  }
  walk_slices(lanes_, windows, active, met, set_);
  if (windows.first == 0) {
    place_steps(1.0);
  }
}

// Sets how far all rays move per slice; in a slice they advance `through` cells along the major axis.
inline void SliceWalk::place_steps(double through) {
  compiled_for(set_, [steps = steps_, by = through * SliceLanes::kCell, slope_u = lines.slope[0].data(),
                      slope_v = lines.slope[1].data(), u = lanes_.step_u.data(), v = lanes_.step_v.data()] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      u[i] = static_cast<std::int32_t>(steps(slope_u[i] * by));
      v[i] = static_cast<std::int32_t>(steps(slope_v[i] * by));
    }
  });
}

// Places all rays at the distance `enters` from the origin, in cells along the major axis. Positions are clamped,
// because inactive rays may be anywhere.
inline void SliceWalk::place_lanes(const SliceBeam& beam, const SlicePlace& place, double enters) {
  compiled_for(set_, [places = places_, by = enters * SliceLanes::kCell,
                      from_u = (beam.within[0] + (beam.first[0] - place.first_u)) * SliceLanes::kCell,
                      from_v = (beam.within[1] + (beam.first[1] - place.first_v)) * SliceLanes::kCell,
                      slope_u = lines.slope[0].data(), slope_v = lines.slope[1].data(), u = lanes_.u.data(),
                      v = lanes_.v.data()] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      u[i] = static_cast<std::int32_t>(places(from_u + slope_u[i] * by));
      v[i] = static_cast<std::int32_t>(places(from_v + slope_v[i] * by));
    }
  });
}

// The rays that end within this distance, in cells along the major axis.
inline std::uint64_t SliceWalk::ending_by(double distance) const {
  RayBlock::PerRay<std::int32_t> flags;
  compiled_for(set_, [distance, length = lines.length.data(), ends = flags.data()] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      ends[i] = length[i] <= distance ? 1 : 0;
    }
  });
  return equal_to(flags, 1, set_);
}

// The walk ignores the ends of rays. So a hit behind the end is removed, and a hit in the slice of the end is
// doubtful. The first slice of the walk starts at minus `to_first`.
inline void SliceWalk::end_rays(std::uint64_t ending, double to_first, SliceHits& met) const {
  for (ending &= met.stopped; ending != 0; ending &= ending - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(ending));
    const std::uint64_t ray = std::uint64_t{1} << i;
    const double end = lines.length[i] + to_first;
    const std::int32_t slice = SliceHits::slice(met.where[i]);
    if (static_cast<double>(slice + 1) > end - SliceBeam::kRounding) {
      met.stopped &= ~ray;
      met.where[i] = -1;
      met.doubtful |= static_cast<double>(slice) < end + SliceBeam::kRounding ? ray : 0;
    }
  }
}

}  // namespace vantage::detail
