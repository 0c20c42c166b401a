// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/raytrace/impl/slice_walk.hpp>

namespace vantage {

static_assert(SliceBeam::kRounding * SliceLanes::kCell + 10 < SliceLanes::kDoubt);

VANTAGE_INLINE void SliceWalk::walk(const SliceBeam& beam, const SliceWindows& windows, std::uint64_t active,
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
VANTAGE_INLINE void SliceWalk::place_steps(double through) {
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
VANTAGE_INLINE void SliceWalk::place_lanes(const SliceBeam& beam, const SlicePlace& place, double enters) {
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
VANTAGE_INLINE std::uint64_t SliceWalk::ending_by(double distance) const {
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
VANTAGE_INLINE void SliceWalk::end_rays(std::uint64_t ending, double to_first, SliceHits& met) const {
  for (ending &= met.stopped; ending != 0; ending &= ending - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(ending));
    const std::uint64_t ray = std::uint64_t{1} << i;
    const double end = lines.length[i] + to_first;
    const std::int32_t slice = met.where[i] >> 9;
    if (static_cast<double>(slice + 1) > end - SliceBeam::kRounding) {
      met.stopped &= ~ray;
      met.where[i] = -1;
      met.doubtful |= static_cast<double>(slice) < end + SliceBeam::kRounding ? ray : 0;
    }
  }
}

}  // namespace vantage
