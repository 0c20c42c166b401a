// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>
#include <vantage/raytrace/impl/tile_hits.hpp>

namespace vantage::detail {

/// A stop of a beam: the next slices [slice, next) of one layer in which a cell may stop one of its rays.
struct Stop {
  std::int64_t slice = 0;  ///< there is no stop if this lies behind the last slice
  std::int64_t next = 0;
  LateralCells cells{};  ///< where the rays may be in these slices
  bool held = true;      ///< whether the slices know all these cells

  /// Whether windows that start at a word boundary can contain the cells.
  [[nodiscard]] bool fits_windows() const {
    return cells.hi[0] - (cells.lo[0] & ~3) < SliceWindows::kWidth &&
           cells.hi[1] - (cells.lo[1] & ~3) < SliceWindows::kHeight;
  }
};

/// The walk of 64 rays of one class through slices: as one beam through free layers, and as lanes where a cell may
/// stop them.
class SliceWalk {
 public:
  static constexpr int kFewRays = 4;  ///< fewer rays are better walked one by one

  explicit SliceWalk(InstructionSet set) : set_(set) {}

  /// Follows the `active` rays, which lie inside `beam`, from this stop on to the cells that stop them, and up to the
  /// last slice. `slices` (GridSlices or ViewSlices) finds the stops and their windows. Returns the rays that must be
  /// walked otherwise: doubtful ones, and those that spread too far.
  template <class Slices>
  [[nodiscard]] std::uint64_t follow(Slices& slices, SliceBeam beam, std::uint64_t active, Stop stop, HitSink& hits);
  /// Prepares `walk` for the current lines; `follow` does so itself.
  void start() { place_steps(1.0); }
  /// Walks the `active` rays through the windows; the ends of the rays are ignored.
  void walk(const SliceBeam& beam, const SliceWindows& windows, std::uint64_t active, SliceHits& met);

  /// The rays. The walk starts with the slopes set.
  RayLines lines;
  /// The smallest length of a ray, if rays may end before the last slice.
  double shortest = std::numeric_limits<double>::infinity();

 private:
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

  InstructionSet set_;
  Clamp steps_{-1.0 * SliceLanes::kCell, 1.0 * SliceLanes::kCell};
  Clamp places_{-1.0 * SliceLanes::kCell, 1.0 * SliceWindows::kWidth* SliceLanes::kCell};
  SliceLanes lanes_;
  SliceWindows windows_;
};

template <class Slices>
std::uint64_t SliceWalk::follow(Slices& slices, SliceBeam beam, std::uint64_t active, Stop stop, HitSink& hits) {
  std::uint64_t others = 0;
  start();
  for (; active != 0 && stop.slice <= slices.last(); stop = slices.next_stop(beam, stop.next)) {
    // The slices do not know all cells on the way.
    if (!stop.held) {
      return others | active;
    }
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
          others |= follow(slices, beam, some, slices.next_stop(beam, stop.slice), hits);
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
