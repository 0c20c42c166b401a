// SPDX-License-Identifier: MIT
#pragma once

// ViewWalk, second part: rays and beams move through slices.
#include <algorithm>
#include <bit>
#include <tuple>
#include <vantage/raytrace/impl/clamped.hpp>
#include <vantage/raytrace/impl/lane_queries.hpp>
#include <vantage/raytrace/impl/view_walk.hpp>

namespace vantage {
namespace detail {

// Whether a window that starts at a word boundary can contain these cells.
inline bool is_in_window(const LateralCells& cells) {
  return cells.hi[0] - (cells.lo[0] & ~3) < SliceWindows::kWidth &&
         cells.hi[1] - (cells.lo[1] & ~3) < SliceWindows::kHeight;
}

}  // namespace detail

// Computes the slopes of all rays of a tile. Returns those inside this beam.
VANTAGE_INLINE std::uint64_t ViewWalk::measure(const std::array<RayBlock::PerRay<float>, 3>& directions,
                                               const SliceBeam& beam) {
  RayBlock::PerRay<std::int32_t> flags;
  const float* const x = directions[0].data();
  const float* const y = directions[1].data();
  const float* const z = directions[2].data();
  double* const slope_u = slope_[0].data();
  double* const slope_v = slope_[1].data();
  compiled_for(set_, [=, &flags, sensor = sensor_, major = beam.axes.major, lateral_u = beam.axes.u,
                      lateral_v = beam.axes.v, sign = beam.axes.up ? 1.0 : -1.0, least_u = beam.least[0],
                      most_u = beam.most[0], least_v = beam.least[1], most_v = beam.most[1]] {
    std::int32_t* const flag = flags.data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      const double forwards = sign * sensor.rotated(major, x[i], y[i], z[i]);
      const double per_cell = 1.0 / forwards;
      const double u = sensor.rotated(lateral_u, x[i], y[i], z[i]) * per_cell;
      const double v = sensor.rotated(lateral_v, x[i], y[i], z[i]) * per_cell;
      slope_u[i] = u;
      slope_v[i] = v;
      flag[i] = static_cast<std::int32_t>(forwards > 0.0) & static_cast<std::int32_t>(u >= least_u) &
                static_cast<std::int32_t>(u <= most_u) & static_cast<std::int32_t>(v >= least_v) &
                static_cast<std::int32_t>(v <= most_v);
    }
  });
  return equal_to(flags, 1, set_);
}

// Sets how far all rays move per slice; in a slice they advance `through` cells along the major axis.
VANTAGE_INLINE void ViewWalk::place_steps(double through) {
  const Clamped steps{-1.0 * SliceLanes::kCell, 1.0 * SliceLanes::kCell};
  const double* const slope_u = slope_[0].data();
  const double* const slope_v = slope_[1].data();
  std::int32_t* const u = lanes_.step_u.data();
  std::int32_t* const v = lanes_.step_v.data();
  compiled_for(set_, [=, by = through * SliceLanes::kCell] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      u[i] = static_cast<std::int32_t>(steps(slope_u[i] * by));
      v[i] = static_cast<std::int32_t>(steps(slope_v[i] * by));
    }
  });
}

// Shrinks the beam to these rays.
VANTAGE_INLINE void ViewWalk::tighten(std::uint64_t active) {
  for (std::size_t i = 0; i < 2; ++i) {
    std::tie(beam_.least[i], beam_.most[i]) = range_of(slope_[i], active, set_);
  }
}

// The first slices, from this one on, in which a cell may stop a ray of the beam.
VANTAGE_INLINE ViewWalk::Stop ViewWalk::next_stop(Class& of, std::int64_t slice) const {
  const auto stop_in = [&of](std::int64_t first, std::int64_t next,
                             const LateralCells& cells) -> std::optional<Stop> {
    const bool held = of.slices.hold(first, cells);
    return held && !of.slices.any_stops(first, cells) ? std::nullopt
                                                      : std::optional<Stop>({first, next, cells, held});
  };
  while (slice <= of.last) {
    if (const std::int32_t free = of.slices.free_layers(slice); free > 0) {
      slice += beam_.left_in_layer(slice) + std::int64_t{4} * (free - 1);
      continue;
    }
    if (slice == 0) {  // rays start inside slice 0, so they pass only a part of it
      if (const std::optional<Stop> stop = stop_in(0, 1, beam_.cells_in(0, 0))) {
        return *stop;
      }
      slice = 1;
      continue;
    }
    const LateralLayers cells = beam_.layers_from(slice, set_);
    for (std::size_t k = 0; k < LateralLayers::kLayers && slice <= of.last; ++k) {
      const std::int64_t next = slice + beam_.left_in_layer(slice);
      if (of.slices.free_layers(slice) == 0) {
        if (const std::optional<Stop> stop = stop_in(slice, next, cells[k])) {
          return *stop;
        }
      }
      slice = next;
    }
  }
  return {slice};
}

// Records the passages of the beam, from this stop on.
VANTAGE_INLINE ViewWalk::Known ViewWalk::record(Class& of, Stop stop) {
  passages_.clear();
  bool tells = flood_.begin(beam_);
  std::uint32_t any_of_box = 0;
  for (; stop.slice <= of.last; stop = next_stop(of, stop.next)) {
    tells = tells && stop.held && detail::is_in_window(stop.cells) && passages_.size() < BeamPassages::kMost;
    if (!tells) {
      fits_by_parts_ =
          stop.cells.extent(0) < 2 * SliceWindows::kWidth && stop.cells.extent(1) < 2 * SliceWindows::kHeight;
      return Known::Nothing;
    }
    BeamPassages::Passage& passage = passages_.next();
    passage.first = cut(of, stop, passage.windows);
    if (passage.windows.count == 0) {
      continue;
    }
    passage.place = place_;
    const bool any_left = flood_.pass(passage.windows, place_, passage.first, passage.wanted);
    for (const WindowRows& rows : passage.wanted) {
      for (const std::uint32_t row : rows) {
        any_of_box |= row;
      }
    }
    passages_.keep(beam_);
    if (!any_left) {
      break;
    }
  }
  return any_of_box != 0 ? Known::Passages : Known::Free;
}

VANTAGE_INLINE std::uint64_t ViewWalk::follow_recorded(std::uint64_t active, HitSink& hits) {
  std::uint64_t others = 0;
  place_steps(1.0);
  std::uint64_t left = to_pass_;
  while (left != 0 && active != 0) {
    constexpr unsigned kMost = SliceWindows::kMost;
    const auto number = static_cast<unsigned>(std::countr_zero(left)) / kMost;
    const auto slices = static_cast<unsigned>(left >> kMost * number & ((1U << kMost) - 1));
    left &= ~std::uint64_t{0} << kMost * number << kMost;
    BeamPassages::Passage& passage = passages_[number];
    const auto skipped = static_cast<std::size_t>(std::countr_zero(slices));
    windows_.count = static_cast<std::size_t>(std::bit_width(slices)) - skipped;
    std::copy_n(passage.windows.rows.begin() + static_cast<std::ptrdiff_t>(skipped), windows_.count,
                windows_.rows.begin());
    const std::int64_t first = passage.first + static_cast<std::int64_t>(skipped);
    place_ = passage.place;
    place_.along = beam_.along(first);
    SliceHits met;
    met.where.fill(-1);
    walk_windows(windows_, first, active, met);
    others |= met.doubtful;
    active &= ~(met.stopped | met.doubtful);
    if (met.stopped == 0) {
      continue;
    }
    std::uint64_t found = 0;
    for (std::uint64_t stopped = met.stopped & changes_of(met.where, set_); stopped != 0; stopped &= stopped - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(stopped));
      const auto where = static_cast<std::uint32_t>(met.where[lane]);
      std::uint32_t& row = passage.wanted[skipped + (where >> 9U)][where >> 5U & 15U];
      const std::uint32_t bit = std::uint32_t{1} << (where & 31U);
      found |= std::uint64_t{(row & bit) != 0} << lane;
      row &= ~bit;
    }
    met.stopped = found;
    if (found != 0) {
      hits.take(met, place_);
    }
  }
  return others;
}

// Cuts the windows of a stop that `held` and is_in_window allow. Returns the first of their slices.
VANTAGE_INLINE std::int64_t ViewWalk::cut(const Class& of, const Stop& stop, SliceWindows& windows) {
  place_ = beam_.axes;
  place_.first_u = stop.cells.lo[0] & ~3;
  place_.first_v = stop.cells.lo[1] & ~3;
  const ViewSlices::Slices slices = of.slices.cut(stop.slice, stop.next, stop.cells, place_, windows);
  place_.along = beam_.along(slices.first);
  return slices.first;
}

VANTAGE_INLINE void ViewWalk::walk_windows(const SliceWindows& windows, std::int64_t first, std::uint64_t active,
                                           SliceHits& met) {
  place_lanes(beam_.entered_at(first));
  if (first == 0) {  // rays start inside slice 0, so they pass only a part of it
    place_steps(beam_.entered_at(1));
  }
  walk_slices(lanes_, windows, active, met, set_);
  if (first == 0) {
    place_steps(1.0);
  }
}

// Follows rays of the beam from this stop on. Returns those that must be walked otherwise.
VANTAGE_INLINE std::uint64_t ViewWalk::follow(Class& of, std::uint64_t active, Stop stop, HitSink& hits) {
  std::uint64_t others = 0;
  place_steps(1.0);
  for (; active != 0 && stop.slice <= of.last; stop = next_stop(of, stop.next)) {
    if (!stop.held) {
      return others | active;
    }
    if (!detail::is_in_window(stop.cells)) {
      return others | follow_quarters(of, active, stop.slice, hits);
    }
    const std::int64_t first = cut(of, stop, windows_);
    if (windows_.count == 0) {
      continue;
    }
    SliceHits met;
    met.where.fill(-1);
    walk_windows(windows_, first, active, met);
    if (met.stopped != 0) {
      hits.take(met, place_);
    }
    others |= met.doubtful;
    if (const std::uint64_t gone = met.stopped | met.doubtful; gone != 0) {
      active &= ~gone;
      if (active == 0) {
        break;
      }
      tighten(active);
    }
  }
  return others;
}

VANTAGE_INLINE std::uint64_t ViewWalk::follow_quarters(Class& of, std::uint64_t active, std::int64_t slice,
                                                       HitSink& hits) {
  std::uint64_t others = 0;
  for (unsigned quarter = 0; quarter < 4; ++quarter) {
    const std::uint64_t some = active & std::uint64_t{0xFFFF} << 16U * quarter;
    if (some == active) {
      return active;
    }
    if (some != 0) {
      tighten(some);
      others |= follow(of, some, next_stop(of, slice), hits);
    }
  }
  return others;
}

// Places all rays at the distance `enters` from the origin, in cells along the major axis.
VANTAGE_INLINE void ViewWalk::place_lanes(double enters) {
  const Clamped places{-1.0 * SliceLanes::kCell, 1.0 * SliceWindows::kWidth * SliceLanes::kCell};
  const double from_u = (beam_.within[0] + (beam_.first[0] - place_.first_u)) * SliceLanes::kCell;
  const double from_v = (beam_.within[1] + (beam_.first[1] - place_.first_v)) * SliceLanes::kCell;
  const double* const slope_u = slope_[0].data();
  const double* const slope_v = slope_[1].data();
  std::int32_t* const u = lanes_.u.data();
  std::int32_t* const v = lanes_.v.data();
  compiled_for(set_, [=, by = enters * SliceLanes::kCell] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      u[i] = static_cast<std::int32_t>(places(from_u + slope_u[i] * by));
      v[i] = static_cast<std::int32_t>(places(from_v + slope_v[i] * by));
    }
  });
}

}  // namespace vantage
