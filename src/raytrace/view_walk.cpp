// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <raytrace/clamped.hpp>
#include <raytrace/lane_queries.hpp>
#include <raytrace/view_walk.hpp>
#include <tuple>

namespace vantage {
namespace {

constexpr std::size_t kLanes = RayBlock::kRays;

// The rays of a cone that are as far from the sensor are no further from its axis than that distance times this: the
// chord of its half angle.
double chord_of(const RayCone& cone) {
  constexpr double kLooseness = 1e-5;  // of rotations
  return std::sqrt(2.0 * (1.0 - cone.cos_half_angle)) + kLooseness;
}

// The lateral spread of all that a box shows to the origin of a beam; as wide as a class of rays is, if it is not all
// in front.
void spread_over(SliceBeam& beam, const VoxelBox& box) {
  constexpr double kSlack = 1e-4;  // more than rounding and what culling lets pass
  const VoxelIndex origin = beam.axes.at(beam.first_along, beam.first[0], beam.first[1]);
  const VoxelIndex lo = box.lo - origin;
  const VoxelIndex hi = box.hi - origin;
  const auto along = [](const VoxelIndex& cell, std::size_t axis) {
    return static_cast<double>(axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z);
  };
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

}  // namespace

ViewWalk::ViewWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor,
                   const VoxelBox& box, InstructionSet set)
    : grid_(grid),
      frame_(frame),
      sensor_(world_from_sensor),
      origin_(world_from_sensor.translation()),
      box_(box),
      set_(set) {}

void ViewWalk::enter(const TileGroup& group, const TileHulls& hulls, double free_m) {
  cone_ = group.cone;
  free_m_ = free_m;
  of_group_ = &class_of(group.cone.axis);
  of_class_ = 0;
  if (!of_group_->is_narrow) {
    return;
  }
  of_class_ = measure(hulls.corners, of_group_->beam.axes, kAllOfClass);
  of_class_ &= of_class_ >> 2 * TileHulls::kTiles;
  of_class_ &= of_class_ >> TileHulls::kTiles;
  of_class_ &= (std::uint64_t{1} << (group.last - group.first)) - 1;
  if (of_class_ == 0) {
    return;
  }
  spread_tiles();
  std::array<double, 2> least{1.0, 1.0};
  std::array<double, 2> most{-1.0, -1.0};
  for (std::uint64_t left = of_class_; left != 0; left &= left - 1) {
    const auto tile = static_cast<std::size_t>(std::countr_zero(left));
    for (std::size_t i = 0; i < 2; ++i) {
      least[i] = std::min(least[i], least_[i][tile]);
      most[i] = std::max(most[i], most_[i][tile]);
    }
  }
  turn_to(*of_group_, least, most);
  from_ =
      beam_.is_empty() ? of_group_->last + 1 : next_stop(*of_group_, first_slice(*of_group_, cone_, free_m)).slice;
}

// From the slopes of their corners, of which one kind is side by side.
void ViewWalk::spread_tiles() {
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

// Makes a beam of this class and this spread, but no wider than the box is.
void ViewWalk::turn_to(const Class& of, const std::array<double, 2>& least, const std::array<double, 2>& most) {
  beam_ = of.beam;
  for (std::size_t i = 0; i < 2; ++i) {
    beam_.least[i] = std::max(beam_.least[i], least[i]);
    beam_.most[i] = std::min(beam_.most[i], most[i]);
  }
}

std::uint64_t ViewWalk::walk(const RayTile& tile, std::size_t number, std::uint64_t rays, HitSink& hits) {
  if ((of_class_ >> number & 1U) == 0) {
    return walk_mixed(tile, rays, hits);
  }
  if (from_ > of_group_->last) {
    return 0;
  }
  constexpr int kFew = 4;
  if (std::popcount(rays) < kFew) {
    return rays;
  }
  turn_to(*of_group_, {least_[0][number], least_[1][number]}, {most_[0][number], most_[1][number]});
  if (beam_.is_empty()) {
    return 0;
  }
  const Stop stop = next_stop(*of_group_, from_);
  if (stop.slice > of_group_->last) {
    return 0;
  }
  // Where views are not culled, there may be some that are not in the beam; they meet no cell of the box.
  rays &= measure(tile.directions, of_group_->beam.axes, {of_group_->beam.least, of_group_->beam.most});
  return follow(*of_group_, rays, stop, hits);
}

// Class by class.
std::uint64_t ViewWalk::walk_mixed(const RayTile& tile, std::uint64_t rays, HitSink& hits) {
  std::uint64_t others = 0;
  while (rays != 0) {
    const auto first = static_cast<std::size_t>(std::countr_zero(rays));
    Class& of = class_of(tile.direction(first).cast<double>());
    const std::uint64_t of_class = of.is_narrow ? measure(tile.directions, of.beam.axes, kAllOfClass) & rays : 0;
    constexpr int kFew = 4;
    if (std::popcount(of_class) < kFew) {
      others |= of_class | (std::uint64_t{1} << first);
    } else {
      beam_ = of.beam;
      tighten(of_class);
      others |= follow(of, of_class, next_stop(of, first_slice(of, cone_, free_m_)), hits);
    }
    rays &= ~(of_class | std::uint64_t{1} << first);
  }
  return others;
}

ViewWalk::Class& ViewWalk::class_of(const Eigen::Vector3d& direction) {
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

ViewWalk::Class ViewWalk::made(std::size_t major, bool up) const {
  Class of{SliceBeam(frame_, origin_, major, up), ViewSlices(grid_, set_)};
  of.last = of.beam.last_slice_of(box_);
  spread_over(of.beam, box_);
  of.is_narrow = of.last < SliceBeam::kLastOfLayers && of.slices.begin(of.beam, of.last);
  return of;
}

std::int64_t ViewWalk::first_slice(const Class& of, const RayCone& cone, double free_m) const {
  constexpr double kSlowest = 0.577;  // less than 1 / sqrt(3): a slower ray is of another class
  const double forwards = std::abs(sensor_.rotated(of.beam.axes.major, cone.axis.x(), cone.axis.y(), cone.axis.z()));
  const double free_cells = std::max(forwards - chord_of(cone), kSlowest) * free_m / frame_.size_m;
  return static_cast<std::int64_t>(std::max(free_cells + of.beam.from_entry - SliceBeam::kRounding, 0.0));
}

// Slopes of all rays of a tile. Returns those that are of the class, and of this spread.
std::uint64_t ViewWalk::measure(const std::array<RayBlock::PerRay<float>, 3>& directions, const SlicePlace& axes,
                                const Spread& spread) {
  RayBlock::PerRay<std::int32_t> flags;
  const float* const x = directions[0].data();
  const float* const y = directions[1].data();
  const float* const z = directions[2].data();
  double* const slope_u = slope_[0].data();
  double* const slope_v = slope_[1].data();
  compiled_for(set_, [=, &flags, sensor = sensor_, major = axes.major, lateral_u = axes.u, lateral_v = axes.v,
                      sign = axes.up ? 1.0 : -1.0, least_u = spread.least[0], most_u = spread.most[0],
                      least_v = spread.least[1], most_v = spread.most[1]] {
    std::int32_t* const flag = flags.data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < kLanes; ++i) {
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

// How far all rays go on their way through a slice, of `through` cells.
void ViewWalk::place_steps(double through) {
  const Clamped steps{-1.0 * SliceLanes::kCell, 1.0 * SliceLanes::kCell};
  const double* const slope_u = slope_[0].data();
  const double* const slope_v = slope_[1].data();
  std::int32_t* const u = lanes_.step_u.data();
  std::int32_t* const v = lanes_.step_v.data();
  compiled_for(set_, [=, by = through * SliceLanes::kCell] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < kLanes; ++i) {
      u[i] = static_cast<std::int32_t>(steps(slope_u[i] * by));
      v[i] = static_cast<std::int32_t>(steps(slope_v[i] * by));
    }
  });
}

// Puts the beam around these rays.
void ViewWalk::tighten(std::uint64_t active) {
  for (std::size_t i = 0; i < 2; ++i) {
    std::tie(beam_.least[i], beam_.most[i]) = range_of(slope_[i], active, set_);
  }
}

// Where something may first stop a ray of the beam, from this slice on.
ViewWalk::Stop ViewWalk::next_stop(Class& of, std::int64_t slice) const {
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
    if (slice == 0) {  // of which they pass a part
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

// Follows rays of the beam from this stop on; returns those that are left to others.
std::uint64_t ViewWalk::follow(Class& of, std::uint64_t active, Stop stop, HitSink& hits) {
  std::uint64_t others = 0;
  place_ = beam_.axes;
  place_steps(1.0);
  for (; active != 0 && stop.slice <= of.last; stop = next_stop(of, stop.next)) {
    const LateralCells& cells = stop.cells;
    if (!stop.held) {
      return others | active;
    }
    if (cells.hi[0] - (cells.lo[0] & ~3) >= SliceWindows::kWidth ||
        cells.hi[1] - (cells.lo[1] & ~3) >= SliceWindows::kHeight) {
      return others | follow_quarters(of, active, stop.slice, hits);
    }
    place_.first_u = cells.lo[0] & ~3;
    place_.first_v = cells.lo[1] & ~3;
    const ViewSlices::Slices slices = of.slices.cut(stop.slice, stop.next, cells, place_, windows_);
    if (windows_.count == 0) {
      continue;
    }
    place_.along = beam_.along(slices.first);
    place_lanes(beam_.entered_at(slices.first));
    if (slices.first == 0) {  // of which they pass a part
      place_steps(beam_.entered_at(1));
    }
    SliceHits met;
    met.where.fill(-1);
    walk_slices(lanes_, windows_, active, met, set_);
    if (slices.first == 0) {
      place_steps(1.0);
    }
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

std::uint64_t ViewWalk::follow_quarters(Class& of, std::uint64_t active, std::int64_t slice, HitSink& hits) {
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

// Puts all rays where they are `enters` cells from the origin.
void ViewWalk::place_lanes(double enters) {
  const Clamped places{-1.0 * SliceLanes::kCell, 1.0 * SliceWindows::kWidth * SliceLanes::kCell};
  const double from_u = (beam_.within[0] + (beam_.first[0] - place_.first_u)) * SliceLanes::kCell;
  const double from_v = (beam_.within[1] + (beam_.first[1] - place_.first_v)) * SliceLanes::kCell;
  const double* const slope_u = slope_[0].data();
  const double* const slope_v = slope_[1].data();
  std::int32_t* const u = lanes_.u.data();
  std::int32_t* const v = lanes_.v.data();
  compiled_for(set_, [=, by = enters * SliceLanes::kCell] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < kLanes; ++i) {
      u[i] = static_cast<std::int32_t>(places(from_u + slope_u[i] * by));
      v[i] = static_cast<std::int32_t>(places(from_v + slope_v[i] * by));
    }
  });
}

}  // namespace vantage
