// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <vantage/geometry/impl/along.hpp>
#include <vantage/raytrace/impl/view_walk.hpp>

namespace vantage {
namespace detail {

inline constexpr int kFewRays = 4;

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

}  // namespace detail

VANTAGE_INLINE ViewWalk::ViewWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor,
                                  const VoxelBox& box, InstructionSet set)
    : grid_(grid),
      frame_(frame),
      sensor_(world_from_sensor),
      origin_(world_from_sensor.translation()),
      box_(box),
      set_(set),
      flood_(box, set) {}

VANTAGE_INLINE void ViewWalk::enter(const TileGroup& group, const TileHulls& hulls) {
  of_group_ = &class_of(group.cone.axis);
  of_class_ = 0;
  if (!of_group_->is_narrow) {
    return;
  }
  of_class_ = measure(hulls.corners, of_group_->all);
  of_class_ &= of_class_ >> 2 * TileHulls::kTiles;
  of_class_ &= of_class_ >> TileHulls::kTiles;
  of_class_ &= (std::uint64_t{1} << (group.last - group.first)) - 1;
  if (of_class_ == 0) {
    return;
  }
  spread_tiles();
  known_ = survey(of_class_, 0);
  of_group_from_ = from_;
  by_parts_ = known_ == Known::Nothing && fits_by_parts_;
  part_ = kParts;
}

// Finds and records what lies on the way of all these tiles, from slice `from` on.
VANTAGE_INLINE ViewWalk::Known ViewWalk::survey(std::uint64_t tiles, std::int64_t from) {
  std::array<double, 2> least{1.0, 1.0};
  std::array<double, 2> most{-1.0, -1.0};
  for (std::uint64_t left = tiles; left != 0; left &= left - 1) {
    const auto tile = static_cast<std::size_t>(std::countr_zero(left));
    for (std::size_t i = 0; i < 2; ++i) {
      least[i] = std::min(least[i], least_[i][tile]);
      most[i] = std::max(most[i], most_[i][tile]);
    }
  }
  turn_to(*of_group_, least, most);
  if (beam_.is_empty()) {
    return Known::Free;
  }
  const Stop stop = next_stop(*of_group_, from);
  from_ = stop.slice;
  return record(*of_group_, stop);
}

// Computes the slopes of each tile from those of its four corners. Equal corners of all tiles are stored side by
// side.
VANTAGE_INLINE void ViewWalk::spread_tiles() {
  compiled_for(set_, [this] {
    constexpr std::size_t kTiles = TileHulls::kTiles;
    for (std::size_t i = 0; i < 2; ++i) {
      const double* const slope = slope_[i].data();
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

// Sets the current beam to these slopes, limited to the beam of the class.
VANTAGE_INLINE void ViewWalk::turn_to(const Class& of, const std::array<double, 2>& least,
                                      const std::array<double, 2>& most) {
  beam_ = of.beam;
  for (std::size_t i = 0; i < 2; ++i) {
    beam_.least[i] = std::max(beam_.least[i], least[i]);
    beam_.most[i] = std::min(beam_.most[i], most[i]);
  }
}

VANTAGE_INLINE bool ViewWalk::may_see(std::size_t number) {
  if ((of_class_ >> number & 1U) == 0) {
    return true;
  }
  if (constexpr std::size_t kOfPart = TileHulls::kTiles / kParts; by_parts_ && part_ != number / kOfPart) {
    part_ = number / kOfPart;
    known_ = survey(of_class_ & ((std::uint64_t{1} << kOfPart) - 1) << kOfPart * part_, of_group_from_);
  }
  if (known_ == Known::Free) {
    return false;
  }
  turn_to(*of_group_, {least_[0][number], least_[1][number]}, {most_[0][number], most_[1][number]});
  if (beam_.is_empty()) {
    return false;
  }
  if (known_ == Known::Passages) {
    passages_.turn_to(beam_, set_);
    to_pass_ = passages_.to_pass(set_);
    return to_pass_ != 0;
  }
  stop_ = next_stop(*of_group_, from_);
  return stop_.slice <= of_group_->last;
}

VANTAGE_INLINE std::uint64_t ViewWalk::walk(const RayTile& tile, std::size_t number, std::uint64_t rays,
                                            HitSink& hits) {
  if ((of_class_ >> number & 1U) == 0) {
    return walk_mixed(tile, rays, hits);
  }
  if (std::popcount(rays) < detail::kFewRays) {
    return rays;
  }
  // Rays outside the beam meet no cell of the box.
  if (known_ == Known::Nothing) {
    return follow(*of_group_, rays & measure(tile.directions, beam_), stop_, hits);
  }
  return follow_recorded(rays & measure(tile.directions, beam_), hits);
}

// Walks a tile whose rays belong to several classes, class by class.
VANTAGE_INLINE std::uint64_t ViewWalk::walk_mixed(const RayTile& tile, std::uint64_t rays, HitSink& hits) {
  std::uint64_t others = 0;
  while (rays != 0) {
    const auto first = static_cast<std::size_t>(std::countr_zero(rays));
    Class& of = class_of(tile.direction(first).cast<double>());
    const std::uint64_t of_class = of.is_narrow ? measure(tile.directions, of.all) & rays : 0;
    if (of.beam.is_empty()) {  // no ray of the class meets a cell of the box
      others |= std::uint64_t{1} << first & ~of_class;
    } else if (std::popcount(of_class) < detail::kFewRays) {
      others |= of_class | (std::uint64_t{1} << first);
    } else {
      beam_ = of.beam;
      tighten(of_class);
      others |= follow(of, of_class, next_stop(of, 0), hits);
    }
    rays &= ~(of_class | std::uint64_t{1} << first);
  }
  return others;
}

VANTAGE_INLINE ViewWalk::Class& ViewWalk::class_of(const Eigen::Vector3d& direction) {
  const auto along = [&](std::size_t axis) {
    return sensor_.rotated(axis, direction.x(), direction.y(), direction.z());
  };
  const auto faster = [&](std::size_t a, std::size_t b) { return std::abs(along(b)) > std::abs(along(a)) ? b : a; };
  const std::size_t major = faster(faster(0, 1), 2);
  const bool up = along(major) > 0.0;
  std::optional<Class>& of = classes_[2 * major + (up ? 1 : 0)];
  if (!of) {
    of.emplace(made(major, up));
  }
  return *of;
}

VANTAGE_INLINE ViewWalk::Class ViewWalk::made(std::size_t major, bool up) const {
  const SliceBeam all(frame_, origin_, major, up);
  Class of{all, all, ViewSlices(grid_, set_)};
  of.last = of.beam.last_slice_of(box_);
  detail::spread_over(of.beam, box_);
  of.is_narrow = of.last < SliceBeam::kLastOfLayers && (of.beam.is_empty() || of.slices.begin(of.beam, of.last));
  return of;
}

}  // namespace vantage
