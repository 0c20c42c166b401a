// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/view/unseen_surface.hpp>

namespace vantage {
namespace detail {

inline constexpr std::uint32_t kCellSides = kAllNeighbours.size();
inline constexpr std::uint32_t kTakenForFree = 1U << kCellSides;

// Cosine of the incidence: under 85 degrees a side is observed. For predictions a side must be turned towards the
// sensor more clearly, so that a view observes what was expected of it.
inline constexpr double kLookedAtCosine = 0.087;
inline constexpr double kExpectedCosine = 0.2;

// 1 across a face, 2 across an edge, 3 across a corner.
inline unsigned axes_of_side(std::uint32_t side) {
  const VoxelIndex& step = kAllNeighbours[side];
  return static_cast<unsigned>(step.x != 0) + static_cast<unsigned>(step.y != 0) + static_cast<unsigned>(step.z != 0);
}

// 4 across a face, 2 across an edge, 1 across a corner.
inline std::size_t weight_of_side(std::uint32_t side) { return std::size_t{8} >> axes_of_side(side); }

// By side: the sides at most 55 degrees apart from it, as a set of bits.
inline constexpr std::array<std::uint32_t, kCellSides> kSimilarSides = [] {
  std::array<std::uint32_t, kCellSides> similar{};
  for (std::uint32_t a = 0; a < kCellSides; ++a) {
    for (std::uint32_t b = 0; b < kCellSides; ++b) {
      const VoxelIndex& m = kAllNeighbours[a];
      const VoxelIndex& n = kAllNeighbours[b];
      const int dot = m.x * n.x + m.y * n.y + m.z * n.z;
      const int squares = (m.x * m.x + m.y * m.y + m.z * m.z) * (n.x * n.x + n.y * n.y + n.z * n.z);
      similar[a] |= dot > 0 && 3 * dot * dot >= squares ? 1U << b : 0U;
    }
  }
  return similar;
}();

// Calls `visit(side)` for the sides whose normal has a cosine to the direction of the sensor above `least_cosine`.
template <class Visit>
void for_each_side_towards(const Eigen::Vector3d& back, double least_cosine, const Visit& visit) {
  const double least = least_cosine * back.norm();
  constexpr std::array<double, 4> kLength{0.0, 1.0, std::numbers::sqrt2, std::numbers::sqrt3};
  for (std::uint32_t side = 0; side < kCellSides; ++side) {
    const VoxelIndex& n = kAllNeighbours[side];
    const double length = kLength[axes_of_side(side)];
    if (n.x * back.x() + n.y * back.y() + n.z * back.z() > least * length) {
      visit(side);
    }
  }
}

// A pseudo-random number in [0, 1) that is fixed for each cell.
inline double draw_of(const VoxelIndex& cell) {
  std::uint64_t h = static_cast<std::uint32_t>(cell.x) * 0x9E3779B97F4A7C15ULL ^
                    static_cast<std::uint32_t>(cell.y) * 0xC2B2AE3D27D4EB4FULL ^
                    static_cast<std::uint32_t>(cell.z) * 0x165667B19E3779F9ULL;
  h = (h ^ h >> 31U) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ h >> 27U) * 0x94D049BB133111EBULL;
  return static_cast<double>((h ^ h >> 31U) >> 11U) * 0x1.0p-53;
}

// Returns the box if its sides can be numbered.
inline const VoxelBox& with_numbered_sides(const VoxelBox& object) {
  if (object.size() > std::numeric_limits<UnseenSurface::Side>::max() / detail::kCellSides) {
    throw std::length_error("UnseenSurface: the box of the object has too many cells; coarser ones will do");
  }
  return object;
}

}  // namespace detail

VANTAGE_INLINE UnseenSurface::UnseenSurface(const OccupancyMap& map, const VoxelBox& object)
    : frame_(map.frame()), looked_(detail::with_numbered_sides(object), 0), unseen_(object, 0), caster_(map) {}

VANTAGE_INLINE void UnseenSurface::look(const OccupancyMap& map, const Pose& world_from_sensor,
                                        const ViewRays& rays) {
  caster_.update();
  suppose(map, 1.0);  // the map may have changed around the box, and then cells there stop rays again
  pass_rays(map, world_from_sensor, rays);
  // While every unknown cell stops rays, the visible cells are those that the sensor may have met.
  suppose(map, 1.0);
  caster_.visible_cells(world_from_sensor, rays, looked_.box()).for_each([&](const VoxelIndex& cell) {
    const Eigen::Vector3d back = world_from_sensor.translation() - frame_.centre_of(cell);
    std::uint32_t& looked = looked_[cell];
    detail::for_each_side_towards(back, detail::kLookedAtCosine, [&](std::uint32_t side) { looked |= 1U << side; });
    if (map.at(cell) == Occupancy::Unknown) {
      looked |= detail::kTakenForFree;
    }
  });
  // A ray through a box of unknown cells meets one surface on average, whatever the size of the cells.
  const VoxelIndex extent = looked_.box().extent();
  suppose(map, 3.0 / (static_cast<double>(extent.x) + extent.y + extent.z));
  find_unseen();
}

// Marks unknown cells that a ray has passed: those before known surface, or on a ray that meets none.
VANTAGE_INLINE void UnseenSurface::pass_rays(const OccupancyMap& map, const Pose& world_from_sensor,
                                             const ViewRays& rays) {
  const Eigen::Vector3d from = world_from_sensor.translation();
  const Box box = frame_.box_of(looked_.box());
  std::vector<RayEnd> ends(rays.size());
  caster_.cast(world_from_sensor, rays, ends);
  for (const RayTile& tile : rays.tiles()) {
    for (std::uint64_t left = tile.rays; left != 0; left &= left - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(left));
      const Eigen::Vector3d reach =
          world_from_sensor.linear() * (tile.direction(place).cast<double>() * tile.stretch[place]);
      // The part of the ray inside the box.
      double enters = 0.0;
      double leaves = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.min[axis] - from[axis]) / reach[axis];
        const double b = (box.max[axis] - from[axis]) / reach[axis];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
      }
      const RayEnd& end = ends[tile.ray[place]];
      const bool stopped_before = end.occupancy != Occupancy::Free && !looked_.contains(end.cell) &&
                                  (frame_.centre_of(end.cell) - from).squaredNorm() < (enters * reach).squaredNorm();
      if (!(enters < leaves) || stopped_before) {
        continue;
      }
      for (const VoxelIndex& cell : VoxelRay(frame_, from + enters * reach, from + leaves * reach)) {
        if (!looked_.contains(cell)) {
          continue;
        }
        const Occupancy state = map.at(cell);
        if (state == Occupancy::Occupied) {
          break;
        }
        if (state == Occupancy::Unknown) {
          looked_[cell] |= detail::kTakenForFree;
        }
      }
    }
  }
}

// Assumes that an unknown cell is occupied with this probability. The cells around the box are assumed to be free:
// a map may know the surroundings up to the cells that the box touches, and these would hide the object.
VANTAGE_INLINE void UnseenSurface::suppose(const OccupancyMap& map, double chance) {
  CellSet stopping(looked_.box().grown(1));
  for_each_cell(looked_.box(), [&](const VoxelIndex& cell) {
    if (map.at(cell) == Occupancy::Unknown && (looked_[cell] & detail::kTakenForFree) == 0 &&
        detail::draw_of(cell) < chance) {
      stopping.insert(cell);
    }
  });
  caster_.suppose(stopping);
}

VANTAGE_INLINE void UnseenSurface::find_unseen() {
  VoxelGrid<std::uint32_t> open(looked_.box(), 0);
  for_each_cell(looked_.box(), [&](const VoxelIndex& cell) {
    for (std::uint32_t side = 0; side < detail::kCellSides && stops(cell); ++side) {
      open[cell] |= (looked_[cell] >> side & 1U) == 0 && open_towards(cell, side) ? 1U << side : 0U;
    }
  });
  for_each_cell(looked_.box(), [&](const VoxelIndex& cell) {
    unseen_[cell] = caster_.at(cell) == Occupancy::Occupied ? in_rows(cell, open) : open[cell];
  });
}

VANTAGE_INLINE std::uint32_t UnseenSurface::in_rows(const VoxelIndex& cell,
                                                    const VoxelGrid<std::uint32_t>& open) const {
  if (open[cell] == 0) {
    return 0;
  }
  std::array<unsigned, detail::kCellSides> alike{};  // by side: occupied neighbours with a similar one
  unsigned occupied = 0;
  for (const VoxelIndex& step : kAllNeighbours) {
    const VoxelIndex beside = cell + step;
    if (!open.contains(beside) || caster_.at(beside) != Occupancy::Occupied) {
      continue;
    }
    ++occupied;
    for (std::uint32_t side = 0; side < detail::kCellSides && open[beside] != 0; ++side) {
      alike[side] += (open[beside] & detail::kSimilarSides[side]) != 0 ? 1U : 0U;
    }
  }
  std::uint32_t sides = 0;
  for (std::uint32_t side = 0; side < detail::kCellSides; ++side) {
    sides |= alike[side] >= std::min(2U, (occupied + 1U) / 2U) ? 1U << side : 0U;
  }
  return open[cell] & sides;
}

VANTAGE_INLINE bool UnseenSurface::open_towards(const VoxelIndex& cell, std::uint32_t side) const {
  const VoxelIndex& step = kAllNeighbours[side];
  for (int part = 1; part < 8; ++part) {
    const VoxelIndex beside{(part & 1) != 0 ? step.x : 0, (part & 2) != 0 ? step.y : 0, (part & 4) != 0 ? step.z : 0};
    if (beside != VoxelIndex{0, 0, 0} && stops(cell + beside)) {
      return false;
    }
  }
  return true;
}

VANTAGE_INLINE std::vector<UnseenSurface::Side> UnseenSurface::expected(const Pose& world_from_sensor,
                                                                        const ViewRays& rays) const {
  std::vector<Side> sides;
  caster_.visible_cells(world_from_sensor, rays, looked_.box()).for_each([&](const VoxelIndex& cell) {
    const Eigen::Vector3d back = world_from_sensor.translation() - frame_.centre_of(cell);
    detail::for_each_side_towards(back, detail::kExpectedCosine, [&](std::uint32_t side) {
      if ((unseen_[cell] >> side & 1U) != 0) {
        sides.push_back(static_cast<Side>(looked_.offset_of(cell) * detail::kCellSides + side));
      }
    });
  });
  std::sort(sides.begin(), sides.end());
  return sides;
}

VANTAGE_INLINE std::size_t UnseenSurface::weight_of(std::span<const Side> sides) {
  std::size_t weight = 0;
  for (const Side side : sides) {
    weight += detail::weight_of_side(side % detail::kCellSides);
  }
  return weight;
}

VANTAGE_INLINE std::vector<CellSide> UnseenSurface::left() const {
  std::vector<CellSide> sides;
  for_each_cell(looked_.box(), [&](const VoxelIndex& cell) {
    if (!stops(cell)) {
      return;
    }
    for (std::uint32_t side = 0; side < detail::kCellSides; ++side) {
      if ((unseen_[cell] >> side & 1U) != 0) {
        sides.push_back({cell, kAllNeighbours[side]});
      }
    }
  });
  return sides;
}

VANTAGE_INLINE std::size_t UnseenSurface::looked_at() const {
  std::size_t weight = 0;
  for_each_cell(looked_.box(), [&](const VoxelIndex& cell) {
    if (caster_.at(cell) != Occupancy::Occupied) {
      return;
    }
    for (std::uint32_t side = 0; side < detail::kCellSides; ++side) {
      const bool observed = (looked_[cell] >> side & 1U) != 0 && open_towards(cell, side);
      weight += observed ? detail::weight_of_side(side) : 0U;
    }
  });
  return weight;
}

}  // namespace vantage
