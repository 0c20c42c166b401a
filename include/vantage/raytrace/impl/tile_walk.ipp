// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/raytrace/impl/clamped.hpp>
#include <vantage/raytrace/impl/lane_queries.hpp>
#include <vantage/raytrace/impl/single_walk.hpp>
#include <vantage/raytrace/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/sliced_word.hpp>
#include <vantage/raytrace/impl/tile_walk.hpp>
#include <vantage/raytrace/impl/word_rows.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kTileRays = RayBlock::kRays;

// Reverses the order of the slices in a word (see in_slices).
inline std::uint64_t reversed(std::uint64_t slices) {
  slices = slices << 32U | slices >> 32U;
  return (slices & 0x0000FFFF0000FFFFU) << 16U | (slices >> 16U & 0x0000FFFF0000FFFFU);
}

}  // namespace detail

VANTAGE_INLINE TileWalk::TileWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin,
                                  InstructionSet set)
    : grid_(grid), reader_(grid), frame_(frame), set_(set), origin_(origin), first_(frame.cell_of(origin)) {
  first_cell_ = {first_.x, first_.y, first_.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    within_first_[axis] = origin[static_cast<Eigen::Index>(axis)] / frame.size_m - first_cell_[axis];
  }
}

VANTAGE_INLINE void TileWalk::walk(const RayBlock& block, std::uint64_t rays, const VoxelBox& within,
                                   double free_share, HitSink& hits) {
  singly_ = 0;
  within_ = within;
  free_share_ = free_share;
  measure(block);
  while (rays != 0) {
    const std::uint64_t of_class = take_class(rays);
    rays &= ~of_class;
    constexpr int kFew = 4;
    if (std::popcount(of_class) < kFew) {
      singly_ |= of_class;
    } else {
      walk_class(of_class, hits);
    }
  }
  walk_singly(block, singly_, hits);
}

VANTAGE_INLINE void TileWalk::measure(const RayBlock& block) {
  compiled_for(set_, [this, &block] {
    const double per_metre = 1.0 / frame_.size_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = origin_[static_cast<Eigen::Index>(axis)];
      const double* const end = block.end[axis].data();
      double* const extent = extent_[axis].data();
      VANTAGE_INDEPENDENT
      for (std::size_t i = 0; i < detail::kTileRays; ++i) {
        extent[i] = (end[i] - from) * per_metre;
      }
    }
  });
}

// Selects the rays of the same class as the first one, and sets the axes to that class.
VANTAGE_INLINE std::uint64_t TileWalk::take_class(std::uint64_t rays) {
  const double* const extent_x = extent_[0].data();
  const double* const extent_y = extent_[1].data();
  const double* const extent_z = extent_[2].data();
  RayBlock::PerRay<std::int32_t> kinds;
  compiled_for(set_, [=, &kinds] {
    std::int32_t* const kind = kinds.data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < detail::kTileRays; ++i) {
      const double x = std::abs(extent_x[i]);
      const double y = std::abs(extent_y[i]);
      const double z = std::abs(extent_z[i]);
      const double by_x = extent_x[i] > 0.0 ? 1.0 : 0.0;
      const double by_y = extent_y[i] > 0.0 ? 3.0 : 2.0;
      const double by_z = extent_z[i] > 0.0 ? 5.0 : 4.0;
      const double of_y_or_z = y >= z ? by_y : by_z;
      const double y_or_z = y >= z ? y : z;
      const double fastest = x >= y_or_z ? by_x : of_y_or_z;
      kind[i] = static_cast<std::int32_t>(fastest);
    }
  });
  const std::int32_t chosen = kinds[static_cast<std::size_t>(std::countr_zero(rays))];
  place_.major = static_cast<std::size_t>(chosen / 2);
  place_.u = place_.major == 0 ? 1 : 0;
  place_.v = place_.major == 2 ? 1 : 2;
  place_.up = chosen % 2 == 1;
  from_entry_ = place_.up ? within_first_[place_.major] : 1.0 - within_first_[place_.major];
  return equal_to(kinds, chosen, set_) & rays;
}

VANTAGE_INLINE void TileWalk::walk_class(std::uint64_t rays, HitSink& hits) {
  const double* const extent_u = extent_[place_.u].data();
  const double* const extent_v = extent_[place_.v].data();
  double* const extent_m = extent_[place_.major].data();
  double* const slope_u = slope_[0].data();
  double* const slope_v = slope_[1].data();
  compiled_for(set_, [=] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < detail::kTileRays; ++i) {
      const double per_cell = 1.0 / std::abs(extent_m[i]);
      slope_u[i] = extent_u[i] * per_cell;
      slope_v[i] = extent_v[i] * per_cell;
    }
  });
  const auto [least, most] = range_of(extent_[place_.major], rays, set_);
  nearest_end_ = place_.up ? least : -most;
  if (!(nearest_end_ > SliceBeam::kRounding)) {
    singly_ |= rays;
    return;
  }
  furthest_end_ = place_.up ? most : -least;
  const double free_cells = free_share_ * nearest_end_ - SliceBeam::kRounding;
  const auto first = static_cast<std::int64_t>(std::max(free_cells + from_entry_, 0.0));
  follow(rays, free_cells > 0.0 ? first : 0, hits);
}

// Follows the rays of a class as one beam from slice `beam` on.
VANTAGE_INLINE void TileWalk::follow(std::uint64_t active, std::int64_t beam, HitSink& hits) {
  const std::int64_t last = last_slice();
  Spread spread = spread_of(active);
  while (active != 0 && beam <= last) {
    const std::int32_t along = first_cell_[place_.major] + static_cast<std::int32_t>(place_.up ? beam : -beam);
    std::int32_t count = place_.up ? 4 - (along & 3) : (along & 3) + 1;
    const Window window = window_of(spread, beam, beam + count - 1);
    const Window words{{window.lo[0] >> 2, window.lo[1] >> 2}, {window.hi[0] >> 2, window.hi[1] >> 2}};
    const std::int32_t layers = free_layers(words, along >> 2);
    if (layers > 0) {
      beam += count + 4 * (layers - 1);
      continue;
    }
    if (words.hi[0] - words.lo[0] >= SliceWindows::kWidth / 4 ||
        words.hi[1] - words.lo[1] >= SliceWindows::kHeight / 4) {
      constexpr int kFew = 16;
      if (std::popcount(active) <= kFew) {
        singly_ |= active;
        return;
      }
      for (unsigned quarter = 0; quarter < 4; ++quarter) {
        follow(active & std::uint64_t{0xFFFF} << 16U * quarter, beam, hits);
      }
      return;
    }
    count = beam == 0 ? 1 : count;  // rays start inside slice 0, so they pass only a part of it
    if (fill_windows(window, beam, static_cast<std::size_t>(count)) && cross(active, beam, hits)) {
      spread = spread_of(active);
    }
    beam += count;
  }
}

// Walks the rays through the windows. Returns whether any ray has left the beam.
VANTAGE_INLINE bool TileWalk::cross(std::uint64_t& active, std::int64_t slice, HitSink& hits) {
  const double enters = entered_at(slice);
  const double leaves = entered_at(slice + static_cast<std::int64_t>(windows_.count));
  const std::uint64_t before = active;
  std::uint64_t ending = 0;
  if (nearest_end_ <= leaves + SliceBeam::kRounding) {
    active &= ~ending_by(enters - SliceBeam::kRounding);
    ending = active & ending_by(leaves + SliceBeam::kRounding);
  }
  place_lanes(enters, slice == 0 ? leaves : 1.0);
  SliceHits of_slices;
  of_slices.where.fill(-1);
  walk_slices(lanes_, windows_, active, of_slices, set_);
  end_rays(ending, slice, of_slices);
  if (of_slices.stopped != 0) {
    hits.take(of_slices, place_);
  }
  singly_ |= of_slices.doubtful;
  active &= ~(of_slices.stopped | of_slices.doubtful | ending);
  return active != before;
}

// The walk ignores the ends of rays. So a hit behind the end is removed, and a hit in the slice of the end is
// doubtful.
VANTAGE_INLINE void TileWalk::end_rays(std::uint64_t ending, std::int64_t slice, SliceHits& of_slices) const {
  for (ending &= of_slices.stopped; ending != 0; ending &= ending - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(ending));
    const std::uint64_t ray = std::uint64_t{1} << i;
    const double end = std::abs(extent_[place_.major][i]) + from_entry_ - static_cast<double>(slice);
    const std::int32_t met = of_slices.where[i] >> 9;
    if (static_cast<double>(met + 1) > end - SliceBeam::kRounding) {
      of_slices.stopped &= ~ray;
      of_slices.where[i] = -1;
      of_slices.doubtful |= static_cast<double>(met) < end + SliceBeam::kRounding ? ray : 0;
    }
  }
}

VANTAGE_INLINE void TileWalk::walk_singly(const RayBlock& block, std::uint64_t rays, HitSink& hits) const {
  for (; rays != 0; rays &= rays - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rays));
    const Eigen::Vector3d end(block.end[0][i], block.end[1][i], block.end[2][i]);
    SingleWalk walk(frame_, origin_, first_, end, frame_.cell_of(end));
    if (walk.advance(grid_)) {
      hits.take(i, walk.cell());
    }
  }
}

// The last slice in which a ray may meet a cell of interest.
VANTAGE_INLINE std::int64_t TileWalk::last_slice() const {
  const std::int32_t first = first_cell_[place_.major];
  const std::array<std::int32_t, 3> lo{within_.lo.x, within_.lo.y, within_.lo.z};
  const std::array<std::int32_t, 3> hi{within_.hi.x, within_.hi.y, within_.hi.z};
  const std::int64_t of_box =
      place_.up ? std::int64_t{hi[place_.major]} - 1 - first : std::int64_t{first} - lo[place_.major];
  return std::min(of_box, static_cast<std::int64_t>(furthest_end_ + from_entry_ + SliceBeam::kRounding));
}

// The rays that end within this distance, in cells along the major axis.
VANTAGE_INLINE std::uint64_t TileWalk::ending_by(double distance) const {
  const double* const extent = extent_[place_.major].data();
  RayBlock::PerRay<std::int32_t> flags;
  compiled_for(set_, [=, &flags] {
    std::int32_t* const ends = flags.data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < detail::kTileRays; ++i) {
      ends[i] = std::abs(extent[i]) <= distance ? 1 : 0;
    }
  });
  return equal_to(flags, 1, set_);
}

// Distance from the origin, in cells along the major axis, at which rays enter a slice.
VANTAGE_INLINE double TileWalk::entered_at(std::int64_t slice) const {
  return std::max(static_cast<double>(slice) - from_entry_, 0.0);
}

// Places all rays at the distance `enters` from the origin; they advance `through` cells per slice (both in cells
// along the major axis).
VANTAGE_INLINE void TileWalk::place_lanes(double enters, double through) {
  const std::array<std::size_t, 2> axes{place_.u, place_.v};
  for (std::size_t lateral = 0; lateral < 2; ++lateral) {
    const std::size_t axis = axes[lateral];
    const double* const slope = slope_[lateral].data();
    std::int32_t* const at = (lateral == 0 ? lanes_.u : lanes_.v).data();
    std::int32_t* const step = (lateral == 0 ? lanes_.step_u : lanes_.step_v).data();
    const double from = within_first_[axis] + (first_cell_[axis] - (lateral == 0 ? place_.first_u : place_.first_v));
    // Clamped, because inactive rays may be anywhere.
    const Clamped places{-1.0 * SliceLanes::kCell, 1.0 * SliceWindows::kWidth * SliceLanes::kCell};
    const Clamped steps{-1.0 * SliceLanes::kCell, 1.0 * SliceLanes::kCell};
    compiled_for(set_, [=, first = from * SliceLanes::kCell, by = enters * SliceLanes::kCell,
                        through = through * SliceLanes::kCell] {
      VANTAGE_INDEPENDENT
      for (std::size_t i = 0; i < detail::kTileRays; ++i) {
        at[i] = static_cast<std::int32_t>(places(first + slope[i] * by));
        step[i] = static_cast<std::int32_t>(steps(slope[i] * through));
      }
    });
  }
}

VANTAGE_INLINE TileWalk::Spread TileWalk::spread_of(std::uint64_t active) const {
  const auto [least_u, most_u] = range_of(slope_[0], active, set_);
  const auto [least_v, most_v] = range_of(slope_[1], active, set_);
  return {{least_u, least_v}, {most_u, most_v}};
}

// The lateral cells in which rays of this spread may be, from the first to the last slice.
VANTAGE_INLINE TileWalk::Window TileWalk::window_of(const Spread& spread, std::int64_t first,
                                                    std::int64_t last) const {
  const double enters = entered_at(first);
  const double leaves = entered_at(last + 1);
  Window window{};
  const std::array<std::size_t, 2> axes{place_.u, place_.v};
  for (std::size_t lateral = 0; lateral < 2; ++lateral) {
    const double least = spread.least[lateral];
    const double most = spread.most[lateral];
    const double from = within_first_[axes[lateral]];
    const double lo = from + least * (least < 0.0 ? leaves : enters) - SliceBeam::kRounding;
    const double hi = from + most * (most > 0.0 ? leaves : enters) + SliceBeam::kRounding;
    window.lo[lateral] = first_cell_[axes[lateral]] + SliceBeam::cell_at(lo);
    window.hi[lateral] = first_cell_[axes[lateral]] + SliceBeam::cell_at(hi);
  }
  return window;
}

// Number of layers, from this one on, that rays can cross freely after they have entered these words. It relies on
// the fact that no ray moves further sideways than forwards.
VANTAGE_INLINE std::int32_t TileWalk::free_layers(const Window& words, std::int32_t along) {
  std::int32_t layers = BlockingGrid::kFurthest;
  for (std::int32_t v = words.lo[1]; v <= words.hi[1]; ++v) {
    for (std::int32_t u = words.lo[0]; u <= words.hi[0]; ++u) {
      layers = std::min<std::int32_t>(layers, reader_.distance(place_.at(along, u, v)));
      if (layers == 0) {
        return 0;
      }
    }
  }
  return layers;
}

// Fills the windows of `count` slices of one layer. Returns false if none of the cells in which rays may be stops a
// ray. (Rows beyond these words keep old values, but no ray gets there.)
VANTAGE_INLINE bool TileWalk::fill_windows(const Window& window, std::int64_t slice, std::size_t count) {
  const std::int32_t along = first_cell_[place_.major] + static_cast<std::int32_t>(place_.up ? slice : -slice);
  const VoxelIndex lo = place_.at(along >> 2, window.lo[0] >> 2, window.lo[1] >> 2);
  windows_.count = count;
  place_.along = along;
  place_.first_u = (window.lo[0] >> 2) * 4;
  place_.first_v = (window.lo[1] >> 2) * 4;
  const std::int32_t u_words = (window.hi[0] >> 2) - (window.lo[0] >> 2);
  const std::int32_t v_words = (window.hi[1] >> 2) - (window.lo[1] >> 2);
  const std::uint32_t columns = ~std::uint32_t{0} << (window.lo[0] & 3) &
                                ~std::uint32_t{0} >> (SliceWindows::kWidth - 1 - (window.hi[0] - place_.first_u));
  const std::uint64_t taken = ~std::uint64_t{0} >> (64U - 16U * count);
  const auto skipped = static_cast<unsigned>(place_.up ? along & 3 : 3 - (along & 3)) * 16U;
  std::array<std::uint64_t, SliceWindows::kWidth / 4> words;
  std::uint32_t any = 0;
  for (std::int32_t v = 0; v <= v_words; ++v) {
    for (std::int32_t u = 0; u <= u_words; ++u) {
      const std::uint64_t slices = in_slices(reader_.blocking(lo + place_.at(0, u, v)), place_.major);
      words[static_cast<std::size_t>(u)] = (place_.up ? slices : detail::reversed(slices)) >> skipped & taken;
    }
    const WordRows rows = rows_of_words(std::span(words).first(static_cast<std::size_t>(u_words) + 1), set_);
    const std::int32_t first = place_.first_v + v * 4;
    for (std::size_t i = 0; i < SliceWindows::kMost; ++i) {
      std::copy_n(&rows[4 * i], 4, &windows_.rows[i][static_cast<std::size_t>(v) * 4]);
      for (std::int32_t r = 0; r < 4; ++r) {
        const bool is_met = window.lo[1] <= first + r && first + r <= window.hi[1];
        any |= is_met ? rows[4 * i + static_cast<std::size_t>(r)] : 0;
      }
    }
  }
  return (any & columns) != 0;
}

}  // namespace vantage
