// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <raytrace/blocking_grid.hpp>
#include <raytrace/lane_queries.hpp>
#include <raytrace/single_walk.hpp>
#include <raytrace/tile_walk.hpp>
#include <raytrace/view_placer.hpp>
#include <stdexcept>
#include <vantage/raytrace/ray_caster.hpp>

#include "map/option_rule.hpp"

namespace vantage {
namespace {

constexpr std::int32_t kFar = kFurthestVoxel;
constexpr VoxelBox kEverywhere{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};

// Has memory that is needed soon brought near.
template <class T>
void prefetch(const T& object) {
#if defined(__GNUC__)
  constexpr std::size_t kLine = 64;
  const auto* const bytes = reinterpret_cast<const char*>(&object);
  for (std::size_t at = 0; at < sizeof(T); at += kLine) {
    __builtin_prefetch(bytes + at);
  }
#else
  (void)object;
#endif
}

RayCasterOptions validated(const RayCasterOptions& options) {
  detail::require_option(options.level >= 0 && options.level <= 16, "RayCasterOptions::level", options.level,
                         "in [0, 16]");
  return options;
}

// Which rays of a view can meet a box at all.
class BoxCulling {
 public:
  BoxCulling(const Pose& world_from_sensor, const Box& box) : origin_(world_from_sensor.translation()), box_(box) {
    // Far more than rounding can move a ray, far less than a cell.
    const double margin =
        1e-9 * (1.0 + origin_.cwiseAbs().maxCoeff() + box.min.cwiseAbs().maxCoeff() + box.max.cwiseAbs().maxCoeff());
    box_.min.array() -= margin;
    box_.max.array() += margin;
    const Eigen::Vector3d to_centre = box_.centre() - origin_;
    const double distance = to_centre.norm();
    const double radius = 0.5 * box_.extent().norm();
    inside_sphere_ = distance <= radius;
    if (!inside_sphere_) {
      axis_ = world_from_sensor.linear().transpose() * to_centre / distance;
      sin_ = radius / distance;
      cos_ = std::sqrt(1.0 - sin_ * sin_);
      find_outline(world_from_sensor.linear());
    }
  }

  // Whether a cone of rays may meet the box: it meets the cone around the sphere around the box, and is not all on
  // the outer side of a plane through the origin and an edge of the outline of the box.
  [[nodiscard]] bool may_meet(const RayCone& cone) const {
    if (inside_sphere_ || cone.cos_half_angle <= 0.0) {
      return true;
    }
    const double sin_of_sum = cone.sin_half_angle * cos_ + cone.cos_half_angle * sin_;
    const double cos_of_sum = cone.cos_half_angle * cos_ - cone.sin_half_angle * sin_;
    if (sin_of_sum > 0.0 && cone.axis.dot(axis_) < cos_of_sum) {
      return false;
    }
    for (std::size_t i = 0; i < edges_; ++i) {
      constexpr double kFlat = 1e-9;
      if (cone.axis.dot(outwards_[i]) > cone.sin_half_angle + kFlat) {
        return false;
      }
    }
    return true;
  }
  // The tiles of a view that may.
  [[nodiscard]] std::vector<const RayTile*> meeting(const ViewRays& rays) const {
    std::vector<const RayTile*> tiles;
    for (std::size_t i = 0; i < rays.tiles().size(); ++i) {
      if (may_meet(rays.cones()[i])) {
        tiles.push_back(&rays.tiles()[i]);
      }
    }
    return tiles;
  }
  // The rays of a block, placed, that pass through the box.
  [[nodiscard]] std::uint64_t meeting(const RayBlock& block) const {
    RayBlock::PerRay<std::int32_t> flags;
    const double* const end_x = block.end[0].data();
    const double* const end_y = block.end[1].data();
    const double* const end_z = block.end[2].data();
    compiled_for(best_instruction_set(),
                 [=, &flags, lo = Eigen::Vector3d(box_.min - origin_), hi = Eigen::Vector3d(box_.max - origin_),
                  origin = origin_, parallel = 1e-12] {
                   std::int32_t* const meets = flags.data();
                   VANTAGE_INDEPENDENT
                   for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
                     const Share x(lo.x(), hi.x(), end_x[i] - origin.x(), parallel);
                     const Share y(lo.y(), hi.y(), end_y[i] - origin.y(), parallel);
                     const Share z(lo.z(), hi.z(), end_z[i] - origin.z(), parallel);
                     const double enters_xy = x.enters > y.enters ? x.enters : y.enters;
                     const double leaves_xy = x.leaves < y.leaves ? x.leaves : y.leaves;
                     const double enters = enters_xy > z.enters ? enters_xy : z.enters;
                     const double leaves = leaves_xy < z.leaves ? leaves_xy : z.leaves;
                     meets[i] = static_cast<std::int32_t>(enters <= leaves) &
                                static_cast<std::int32_t>(enters <= 1.0) & static_cast<std::int32_t>(leaves >= 0.0);
                   }
                 });
    return equal_to(flags, 1, best_instruction_set());
  }

 private:
  // The part of a ray, of which 1 is all, that lies between two planes across an axis.
  struct Share {
    Share(double lo, double hi, double extent, double parallel) {
      const double per_unit = 1.0 / (std::abs(extent) < parallel ? parallel : extent);
      const double to_lo = lo * per_unit;
      const double to_hi = hi * per_unit;
      enters = to_lo < to_hi ? to_lo : to_hi;
      leaves = to_lo < to_hi ? to_hi : to_lo;
    }
    double enters;
    double leaves;
  };

  // The edges at which a side of the box that looks at the origin meets one that does not.
  void find_outline(const Eigen::Matrix3d& world_from_sensor) {
    const auto side = [&](Eigen::Index axis, bool upper) {
      return (upper ? box_.max : box_.min)[axis] - origin_[axis];
    };
    const auto looks = [&](Eigen::Index axis, bool upper) { return side(axis, upper) * (upper ? 1.0 : -1.0) < 0.0; };
    const Eigen::Vector3d to_centre = box_.centre() - origin_;
    for (Eigen::Index along = 0; along < 3; ++along) {
      const Eigen::Index a = (along + 1) % 3;
      const Eigen::Index b = (along + 2) % 3;
      for (unsigned edge = 0; edge < 4; ++edge) {
        const bool upper_a = (edge & 1U) != 0;
        const bool upper_b = (edge & 2U) != 0;
        if (looks(a, upper_a) != looks(b, upper_b)) {
          Eigen::Vector3d normal = Eigen::Vector3d::Zero();
          normal[a] = side(b, upper_b);
          normal[b] = -side(a, upper_a);
          normal *= (normal.dot(to_centre) > 0.0 ? -1.0 : 1.0) / normal.norm();
          outwards_[edges_++] = world_from_sensor.transpose() * normal;
        }
      }
    }
  }

  Eigen::Vector3d origin_;
  Box box_;
  bool inside_sphere_ = false;
  std::size_t edges_ = 0;                            // of the outline
  std::array<Eigen::Vector3d, 6> outwards_;          // across planes through them and the origin, in the sensor frame
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();  // to the centre of the box, in the sensor frame
  double cos_ = -1.0;                                // of the cone around the box
  double sin_ = 0.0;
};

}  // namespace

struct RayCaster::Grid : BlockingGrid {
  using BlockingGrid::BlockingGrid;
};

RayCaster::RayCaster(const OccupancyMap& map, const RayCasterOptions& options)
    : map_(&map),
      options_(validated(options)),
      frame_{map.resolution_m() * static_cast<double>(1 << options.level)},
      grid_(std::make_unique<Grid>(options.level, options.policy)) {
  update();
}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::size_t RayCaster::update() { return grid_->update(*map_); }

Occupancy RayCaster::at(const VoxelIndex& cell) const { return grid_->at(cell); }

std::size_t RayCaster::memory_bytes() const { return sizeof(*this) + grid_->memory_bytes(); }

RayEnd RayCaster::cast(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  if (!frame_.addressable(from) || !frame_.addressable(to)) {
    throw std::invalid_argument("RayCaster::cast: both ends must be finite and addressable");
  }
  SingleWalk walk(frame_, from, frame_.cell_of(from), to, frame_.cell_of(to));
  walk.advance(*grid_);
  return {walk.cell(), grid_->at(walk.cell())};
}

void RayCaster::cast(const Pose& world_from_sensor, const ViewRays& rays, std::span<RayEnd> ends) const {
  if (ends.size() != rays.size()) {
    throw std::invalid_argument("RayCaster::cast: there must be one end for every ray of the view");
  }
  const ViewPlacer placer(world_from_sensor, rays, frame_);
  TileWalk walk(*grid_, frame_, world_from_sensor.translation(), best_instruction_set());
  RayBlock block;
  TileHits hits;
  VoxelIndex last;
  std::uint64_t occupied = grid_->occupied(BlockingGrid::word_of(last));
  for (std::size_t n = 0; n < rays.tiles().size(); ++n) {
    const RayTile& tile = rays.tiles()[n];
    prefetch(rays.tiles()[std::min(n + 1, rays.tiles().size() - 1)]);
    for (std::size_t i = 0; i < RayTile::kRays; i += 4) {  // of which ends share a line
      __builtin_prefetch(&ends[tile.ray[i]], 1);
    }
    placer.place_ends(tile, block);
    walk.walk(block, tile.rays, kEverywhere, hits);
    std::uint64_t left = tile.rays & ~hits.stopped;
    if (left != 0) {
      placer.place_cells(block);
    }
    for (; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      RayEnd& end = ends[tile.ray[i]];
      end.cell = {block.cell[0][i], block.cell[1][i], block.cell[2][i]};
      end.occupancy = Occupancy::Free;
    }
    for (left = hits.stopped; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const VoxelIndex cell = hits.cell_at(i);
      const VoxelIndex by = {cell.x ^ last.x, cell.y ^ last.y, cell.z ^ last.z};
      if (((by.x | by.y | by.z) & ~3) != 0) {  // seldom: neighbours meet neighbours
        occupied = grid_->occupied(BlockingGrid::word_of(cell));
        last = cell;
      }
      const bool is_occupied = (occupied & BlockingGrid::bit_of(cell)) != 0;
      RayEnd& end = ends[tile.ray[i]];
      end.cell = cell;
      end.occupancy = is_occupied ? Occupancy::Occupied : Occupancy::Unknown;
    }
  }
}

CellSet RayCaster::visible_cells(const Pose& world_from_sensor, const ViewRays& rays, const VoxelBox& box) const {
  CellSet seen(box);
  if (box.empty()) {
    return seen;
  }
  const ViewPlacer placer(world_from_sensor, rays, frame_);
  const BoxCulling culling(world_from_sensor, frame_.box_of(box));
  TileWalk walk(*grid_, frame_, world_from_sensor.translation(), best_instruction_set());
  RayBlock block;
  TileHits hits;
  const std::vector<const RayTile*> tiles = culling.meeting(rays);
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    const RayTile& tile = *tiles[n];
    prefetch(*tiles[std::min(n + 1, tiles.size() - 1)]);
    placer.place_ends(tile, block);
    const std::uint64_t meeting = culling.meeting(block) & tile.rays;
    if (meeting == 0) {
      continue;
    }
    walk.walk(block, meeting, box, hits);
    for (std::uint64_t left = hits.stopped; left != 0;) {
      const VoxelIndex cell = hits.cell_at(static_cast<std::size_t>(std::countr_zero(left)));
      seen.insert(cell);
      left &= ~hits.stopped_by(cell, best_instruction_set());
    }
  }
  if (frame_.box_of(box).distance_to(world_from_sensor.translation()) < rays.min_range_m()) {
    const CellSet all = seen;
    all.for_each([&](const VoxelIndex& cell) {
      if ((frame_.centre_of(cell) - world_from_sensor.translation()).norm() < rays.min_range_m()) {
        seen.erase(cell);
      }
    });
  }
  return seen;
}

std::size_t RayCaster::count(const CellSet& cells, Occupancy occupancy) const {
  std::size_t count = 0;
  cells.for_each_word([&](const VoxelIndex& word, std::uint64_t set) {
    const std::uint64_t occupied = grid_->occupied(word);
    const std::uint64_t blocking = grid_->blocking(word);
    const std::uint64_t wanted = occupancy == Occupancy::Occupied ? occupied
                                 : occupancy == Occupancy::Free   ? ~blocking
                                                                  : blocking & ~occupied;
    count += static_cast<std::size_t>(std::popcount(set & wanted));
  });
  return count;
}

}  // namespace vantage
