// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <raytrace/blocking_grid.hpp>
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
    }
  }

  // Whether the cone of a tile meets the cone around the sphere around the box.
  [[nodiscard]] bool may_meet(const RayTile& tile) const {
    const double sin_of_sum = tile.sin_half_angle * cos_ + tile.cos_half_angle * sin_;
    const double cos_of_sum = tile.cos_half_angle * cos_ - tile.sin_half_angle * sin_;
    return inside_sphere_ || sin_of_sum <= 0.0 || tile.cos_half_angle <= 0.0 || tile.axis.dot(axis_) >= cos_of_sum;
  }
  // The rays of a block, placed, that pass through the box.
  [[nodiscard]] std::uint64_t meeting(const RayBlock& block) const {
    RayBlock::PerRay<std::int64_t> flags;
    const double* const end_x = block.end[0].data();
    const double* const end_y = block.end[1].data();
    const double* const end_z = block.end[2].data();
    compiled_for(best_instruction_set(), [=, &flags, lo = Eigen::Vector3d(box_.min - origin_),
                                          hi = Eigen::Vector3d(box_.max - origin_), origin = origin_] {
      std::int64_t* const meets = flags.data();
      VANTAGE_INDEPENDENT
      for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
        const Share x(lo.x(), hi.x(), end_x[i] - origin.x());
        const Share y(lo.y(), hi.y(), end_y[i] - origin.y());
        const Share z(lo.z(), hi.z(), end_z[i] - origin.z());
        const double enters_xy = x.enters > y.enters ? x.enters : y.enters;
        const double leaves_xy = x.leaves < y.leaves ? x.leaves : y.leaves;
        const double enters = enters_xy > z.enters ? enters_xy : z.enters;
        const double leaves = leaves_xy < z.leaves ? leaves_xy : z.leaves;
        const double from = enters > 0.0 ? enters : 0.0;
        const double to = leaves < 1.0 ? leaves : 1.0;
        meets[i] = static_cast<std::int64_t>(from <= to);
      }
    });
    return equal_to(flags, 1, best_instruction_set());
  }

 private:
  // The part of a ray, of which 1 is all, that lies between two planes across an axis.
  struct Share {
    Share(double lo, double hi, double extent) {
      constexpr double kParallel = 1e-12;
      const double per_unit = 1.0 / ((extent < 0.0 ? -extent : extent) < kParallel ? kParallel : extent);
      const double to_lo = lo * per_unit;
      const double to_hi = hi * per_unit;
      enters = to_lo < to_hi ? to_lo : to_hi;
      leaves = to_lo < to_hi ? to_hi : to_lo;
    }
    double enters;
    double leaves;
  };

  Eigen::Vector3d origin_;
  Box box_;
  bool inside_sphere_ = false;
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
  VoxelIndex word;
  std::uint64_t occupied = grid_->occupied(word);
  for (const RayTile& tile : rays.tiles()) {
    placer.place_ends(tile, block);
    placer.place_cells(block);
    walk.walk(block, tile.rays, kEverywhere, hits);
    for (std::uint64_t left = tile.rays & ~hits.stopped; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      ends[tile.ray[i]] = {{block.cell[0][i], block.cell[1][i], block.cell[2][i]}, Occupancy::Free};
    }
    for (std::uint64_t left = hits.stopped; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const VoxelIndex cell{hits.cell[0][i], hits.cell[1][i], hits.cell[2][i]};
      if (BlockingGrid::word_of(cell) != word) {  // seldom: neighbours meet neighbours
        word = BlockingGrid::word_of(cell);
        occupied = grid_->occupied(word);
      }
      const bool is_occupied = (occupied & BlockingGrid::bit_of(cell)) != 0;
      ends[tile.ray[i]] = {cell, is_occupied ? Occupancy::Occupied : Occupancy::Unknown};
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
  for (const RayTile& tile : rays.tiles()) {
    if (!culling.may_meet(tile)) {
      continue;
    }
    placer.place_ends(tile, block);
    const std::uint64_t meeting = culling.meeting(block) & tile.rays;
    if (meeting == 0) {
      continue;
    }
    placer.place_cells(block);
    walk.walk(block, meeting, box, hits);
    for (std::uint64_t left = hits.stopped; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      seen.insert({hits.cell[0][i], hits.cell[1][i], hits.cell[2][i]});
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
