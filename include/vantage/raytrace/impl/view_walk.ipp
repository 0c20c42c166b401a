// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <vantage/geometry/impl/along.hpp>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/raytrace/impl/view_walk.hpp>

namespace vantage::detail {

// Limits the slopes of a beam to the directions in which a box appears from the origin. Without effect if the box is
// not completely in front of the origin.
inline void spread_over(SliceBeam& beam, const VoxelBox& box) {
  constexpr double kSlack = 1e-4;  // larger than rounding and the tolerance of the culling
  const VoxelIndex origin = beam.axes.at(beam.first_along, beam.first[0], beam.first[1]);
  const VoxelIndex lo = box.lo - origin;
  const VoxelIndex hi = box.hi - origin;
  const double upper = along(hi, beam.axes.major) - beam.within_major();
  const double lower = along(lo, beam.axes.major) - beam.within_major();
  const double nearest = beam.axes.up ? lower : -upper;
  const double furthest = beam.axes.up ? upper : -lower;
  if (nearest < 1.0) {
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t axis = i == 0 ? beam.axes.u : beam.axes.v;
    const double least = along(lo, axis) - beam.within[i];
    const double most = along(hi, axis) - beam.within[i];
    beam.least[i] = std::max(least / (least < 0.0 ? nearest : furthest) - kSlack, -1.0);
    beam.most[i] = std::min(most / (most > 0.0 ? nearest : furthest) + kSlack, 1.0);
  }
}

VANTAGE_INLINE ViewWalk::ViewWalk(SliceWalk& walk, const Pose& world_from_sensor, const VoxelBox& box,
                                  InstructionSet set)
    : walk_(walk), sensor_(world_from_sensor), set_(set), flood_(box, set) {
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    classes_[i] = {walk.beams[i], walk.beams[i].last_slice_of(box), -1};
    spread_over(classes_[i].beam, box);
  }
}

VANTAGE_INLINE bool ViewWalk::enter(const TileGroup& group, const TileHulls& hulls) {
  const Eigen::Vector3d& axis = group.cone.axis;
  const auto along = [&](std::size_t i) { return sensor_.rotated(i, axis.x(), axis.y(), axis.z()); };
  const auto number = static_cast<std::size_t>(class_of_ray(along(0), along(1), along(2)));
  of_group_ = &classes_[number];
  of_class_ = measure(hulls.corners, walk_.beams[number]);
  // Corner k of a tile is lane kTiles * k + the number of the tile. All four corners must belong to the class. Then
  // all rays of the tile do.
  of_class_ &= of_class_ >> 2 * TileHulls::kTiles;
  of_class_ &= of_class_ >> TileHulls::kTiles;
  const std::uint64_t all = (std::uint64_t{1} << (group.last - group.first)) - 1;
  of_class_ &= all;
  if (of_class_ == 0) {
    return true;
  }
  spread_tiles();
  if (Class& of = *of_group_; of.from < 0) {
    constexpr std::int64_t kFurthest = 64;  // a wide beam has too many cells further away
    of.from = of.beam.is_empty() ? 0 : walk_.slices.next_stop(of.beam, 0, std::min(of.last, kFurthest)).slice;
  }
  survey(of_class_, of_group_->from);
  of_group_from_ = from_;
  if (known_ == Known::FirstStop && fits_by_parts_) {
    surveyed_ = 0;
  }
  return known_ != Known::Free || of_class_ != all;
}

// Finds and records what lies on the way of all these tiles, from slice `from` on.
VANTAGE_INLINE void ViewWalk::survey(std::uint64_t tiles, std::int64_t from) {
  surveyed_ = tiles;
  std::array<double, 2> least{1.0, 1.0};
  std::array<double, 2> most{-1.0, -1.0};
  for (std::uint64_t left = tiles; left != 0; left &= left - 1) {
    const auto tile = static_cast<std::size_t>(std::countr_zero(left));
    for (std::size_t i = 0; i < 2; ++i) {
      least[i] = std::min(least[i], least_[i][tile]);
      most[i] = std::max(most[i], most_[i][tile]);
    }
  }
  SliceBeam beam = of_group_->beam;
  narrow(beam, least, most);
  if (beam.is_empty()) {
    known_ = Known::Free;
    return;
  }
  const Stop stop = walk_.slices.next_stop(beam, from, of_group_->last);
  from_ = stop.slice;
  known_ = record(beam, stop);
}

// Records the passages of the beam, from this stop on.
VANTAGE_INLINE ViewWalk::Known ViewWalk::record(const SliceBeam& beam, Stop stop) {
  passages_.clear();
  bool tells = flood_.begin(beam);
  std::uint32_t any_of_box = 0;
  for (; stop.slice <= of_group_->last; stop = walk_.slices.next_stop(beam, stop.next, of_group_->last)) {
    // A list that is not complete tells nothing.
    tells = tells && stop.fits_windows() && passages_.size() < BeamPassages::kMost;
    if (!tells) {
      fits_by_parts_ =
          stop.cells.extent(0) < 2 * SliceWindows::kWidth && stop.cells.extent(1) < 2 * SliceWindows::kHeight;
      return Known::FirstStop;
    }
    BeamPassages::Passage& passage = passages_.next();
    walk_.slices.cut(beam, stop, passage.windows);
    if (passage.windows.count == 0) {
      continue;
    }
    const bool any_left = flood_.pass(passage.windows, passage.wanted);
    for (const WindowRows& rows : passage.wanted) {
      for (const std::uint32_t row : rows) {
        any_of_box |= row;
      }
    }
    passages_.keep(beam);
    if (!any_left) {
      break;
    }
  }
  return any_of_box != 0 ? Known::Passages : Known::Free;
}

// Computes the slopes of each tile from those of its four corners. Equal corners of all tiles are stored side by
// side.
VANTAGE_INLINE void ViewWalk::spread_tiles() {
  compiled_for(set_, [this] {
    constexpr std::size_t kTiles = TileHulls::kTiles;
    for (std::size_t i = 0; i < 2; ++i) {
      const double* const slope = walk_.lines.slope[i].data();
      double* const least = least_[i].data();
      double* const most = most_[i].data();
      VANTAGE_INDEPENDENT
      for (std::size_t tile = 0; tile < kTiles; ++tile) {
        const double a = slope[tile];
        const double b = slope[kTiles + tile];
        const double c = slope[2 * kTiles + tile];
        const double d = slope[3 * kTiles + tile];
        const double less = a < b ? a : b;
        const double more = a < b ? b : a;
        const double also_less = c < d ? c : d;
        const double also_more = c < d ? d : c;
        least[tile] = less < also_less ? less : also_less;
        most[tile] = more > also_more ? more : also_more;
      }
    }
  });
}

// Limits a beam to these slopes.
VANTAGE_INLINE void ViewWalk::narrow(SliceBeam& beam, const std::array<double, 2>& least,
                                     const std::array<double, 2>& most) {
  for (std::size_t i = 0; i < 2; ++i) {
    beam.least[i] = std::max(beam.least[i], least[i]);
    beam.most[i] = std::min(beam.most[i], most[i]);
  }
}

VANTAGE_INLINE bool ViewWalk::look(std::size_t number, Outlook& outlook) {
  if ((of_class_ >> number & 1U) == 0) {
    outlook.known = Known::Nothing;
    return true;
  }
  if ((surveyed_ >> number & 1U) == 0) {
    constexpr std::size_t kOfPart = TileHulls::kTiles / 4;
    survey(of_class_ & ((std::uint64_t{1} << kOfPart) - 1) << number / kOfPart * kOfPart, of_group_from_);
  }
  outlook.known = known_;
  if (known_ == Known::Free) {
    return false;
  }
  outlook.beam = of_group_->beam;
  narrow(outlook.beam, {least_[0][number], least_[1][number]}, {most_[0][number], most_[1][number]});
  if (outlook.beam.is_empty()) {
    return false;
  }
  if (known_ == Known::Passages) {
    outlook.slices = passages_.to_pass(outlook.beam, set_);
    return outlook.slices != 0;
  }
  outlook.stop = walk_.slices.next_stop(outlook.beam, from_, of_group_->last);
  return outlook.stop.slice <= of_group_->last;
}

VANTAGE_INLINE std::uint64_t ViewWalk::walk(const RayTile& tile, const Outlook& outlook, std::uint64_t rays,
                                            HitSink& hits) {
  if (outlook.known == Known::Nothing || std::popcount(rays) < SliceWalk::kFewRays) {
    return rays;
  }
  rays &= measure(tile.directions, outlook.beam);  // rays outside the beam meet no cell of the box
  return outlook.known == Known::Passages ? walk_recorded(outlook, rays, hits)
                                          : walk_.follow(outlook.beam, outlook.stop, of_group_->last, rays, hits);
}

// Walks rays through the slices of the passages that the outlook names.
VANTAGE_INLINE std::uint64_t ViewWalk::walk_recorded(const Outlook& outlook, std::uint64_t active, HitSink& hits) {
  std::uint64_t others = 0;
  SliceWindows windows;
  walk_.start();
  std::uint64_t left = outlook.slices;
  while (left != 0 && active != 0) {
    constexpr unsigned kMost = SliceWindows::kMost;
    const auto number = static_cast<unsigned>(std::countr_zero(left)) / kMost;
    const auto slices = static_cast<unsigned>(left >> kMost * number & ((1U << kMost) - 1));
    left &= ~std::uint64_t{0} << kMost * number << kMost;
    BeamPassages::Passage& passage = passages_[number];
    const auto skipped = static_cast<std::size_t>(std::countr_zero(slices));
    windows.count = static_cast<std::size_t>(std::bit_width(slices)) - skipped;
    std::copy_n(passage.windows.rows.begin() + static_cast<std::ptrdiff_t>(skipped), windows.count,
                windows.rows.begin());
    windows.first = passage.windows.first + static_cast<std::int64_t>(skipped);
    windows.place = passage.windows.place;
    windows.place.along = outlook.beam.along(windows.first);
    SliceHits met;
    met.where.fill(-1);
    walk_.walk(outlook.beam, windows, active, met);
    others |= met.doubtful;
    active &= ~(met.stopped | met.doubtful);
    if (met.stopped == 0) {
      continue;
    }
    std::uint64_t found = 0;
    // A cell is passed on once: the first ray that meets it removes it from the wanted cells. Hits of other rays
    // there are dropped.
    for (std::uint64_t stopped = met.stopped & changes_of(met.where, set_); stopped != 0; stopped &= stopped - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(stopped));
      const std::int32_t where = met.where[lane];
      const auto slice = static_cast<std::size_t>(SliceHits::slice(where));
      std::uint32_t& row = passage.wanted[skipped + slice][static_cast<std::size_t>(SliceHits::row(where))];
      const std::uint32_t bit = std::uint32_t{1} << SliceHits::column(where);
      found |= std::uint64_t{(row & bit) != 0} << lane;
      row &= ~bit;
    }
    met.stopped = found;
    if (found != 0) {
      hits.take(met, windows.place);
    }
  }
  return others;
}

// Computes the slopes of all rays of a tile, as rays without an end. Returns those inside the beam.
VANTAGE_INLINE std::uint64_t ViewWalk::measure(const std::array<RayBlock::PerRay<float>, 3>& directions,
                                               const SliceBeam& beam) {
  RayBlock::PerRay<std::int32_t> flags;
  walk_.shortest = std::numeric_limits<double>::infinity();
  const float* const x = directions[0].data();
  const float* const y = directions[1].data();
  const float* const z = directions[2].data();
  double* const slope_u = walk_.lines.slope[0].data();
  double* const slope_v = walk_.lines.slope[1].data();
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

}  // namespace vantage::detail
