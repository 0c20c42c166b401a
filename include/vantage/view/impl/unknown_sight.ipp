// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/view/unknown_sight.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

// Smaller probabilities are neglected.
inline constexpr double kLeastChance = 0.01;

// The number of cells that a ray from one cell to the other visits, both included.
inline std::uint64_t cells_between(const VoxelIndex& a, const VoxelIndex& b) {
  const VoxelIndex d = b - a;
  return static_cast<std::uint64_t>(std::abs(d.x)) + static_cast<std::uint64_t>(std::abs(d.y)) +
         static_cast<std::uint64_t>(std::abs(d.z)) + 1;
}

}  // namespace detail

// A ray that ends in an unknown cell, with its continuation.
struct UnknownSight::Ray {
  Eigen::Vector3d sensor;
  Eigen::Vector3d direction;
  VoxelIndex end;
  double range_m;
};

// Reads cells one after the other, and keeps the last brick.
class UnknownSight::Reader {
 public:
  explicit Reader(const UnknownSight& sight) : sight_(&sight) {}

  [[nodiscard]] Content operator()(const VoxelIndex& cell) {
    const VoxelIndex brick = Brick::of_cell(cell);
    if (brick != brick_ || (values_ == nullptr && known_ == nullptr)) {
      brick_ = brick;
      const BrickDirectory::Number number = sight_->contents_.number_of(brick);
      values_ = number == BrickDirectory::kNone ? nullptr : &sight_->contents_.values(number);
      known_ = values_ == nullptr ? sight_->map_->find_brick(brick) : nullptr;
    }
    const std::size_t offset = Brick::offset_of(cell);
    if (values_ != nullptr) {
      return (*values_)[offset];
    }
    return known_ != nullptr && known_->at(offset) == Occupancy::Occupied ? Content::Surface : Content::Open;
  }

 private:
  const UnknownSight* sight_;
  VoxelIndex brick_;
  const BrickGrid<Content>::Values* values_ = nullptr;
  const Brick* known_ = nullptr;
};

// The best probability of every cell, as a 16-bit fixed-point number.
class UnknownSight::Chances {
 public:
  Chances(const VoxelBox& box, const Eigen::Vector3d& sensor, double min_range_m, const VoxelFrame& frame)
      : best_(box, 0),
        raised_(static_cast<std::size_t>(box.extent().y) * static_cast<std::size_t>(box.extent().z), 0),
        sensor_(sensor),
        min_range_m_(min_range_m),
        frame_(frame) {}

  void raise(const VoxelIndex& cell, double chance) {
    if (best_.contains(cell)) {
      std::uint16_t& best = best_.values()[best_.offset_of(cell)];
      best = std::max(best, static_cast<std::uint16_t>(std::lrint(chance * kWhole)));
      const VoxelBox& box = best_.box();
      const auto rows = static_cast<std::size_t>(box.hi.y - box.lo.y);
      raised_[static_cast<std::size_t>(cell.z - box.lo.z) * rows + static_cast<std::size_t>(cell.y - box.lo.y)] = 1;
    }
  }
  // Surfaces within the minimum range give no return.
  [[nodiscard]] bool in_range(const VoxelIndex& cell) const {
    return min_range_m_ <= 0.0 || (frame_.centre_of(cell) - sensor_).norm() >= min_range_m_;
  }
  [[nodiscard]] std::vector<SightedCell> cells() const {
    std::vector<SightedCell> seen;
    for (std::size_t row = 0; row < raised_.size(); ++row) {
      if (raised_[row] != 0) {
        append_row(row, seen);
      }
    }
    return seen;
  }

  // A wanted cell on a ray.
  struct Passed {
    VoxelIndex cell;
    double reached;  // probability that the ray reaches it
  };
  std::vector<Passed> on_ray;    // scratch memory of `follow`
  std::uint64_t operations = 0;  // cells on the rays so far

 private:
  static constexpr double kWhole = 65535.0;

  void append_row(std::size_t row, std::vector<SightedCell>& seen) const {
    const std::size_t length = best_.size() / raised_.size();
    for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
      if (best_.values()[i] == 0) {
        continue;
      }
      const VoxelIndex cell = best_.cell_at(i);
      if (in_range(cell)) {
        seen.push_back({cell, best_.values()[i] / kWhole});
      }
    }
  }

  VoxelGrid<std::uint16_t> best_;
  std::vector<std::uint8_t> raised_;  // per row along x: whether a cell has a probability
  Eigen::Vector3d sensor_;
  double min_range_m_;
  VoxelFrame frame_;
};

VANTAGE_INLINE UnknownSight::UnknownSight(const OccupancyMap& map, const BrickSet& wanted,
                                          const UnknownSightOptions& options)
    : map_(&map), frame_(map.frame()), options_(options), bounds_(map.bounds()) {
  detail::require_option(options.opaque_share > 0.0 && options.opaque_share <= 1.0,
                         "UnknownSightOptions::opaque_share", options.opaque_share, "in (0, 1]");
  detail::require_option(options.opaque_beside_surface > 0.0 && options.opaque_beside_surface <= 1.0,
                         "UnknownSightOptions::opaque_beside_surface", options.opaque_beside_surface, "in (0, 1]");
  wanted.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) {
    if (!detail::any(cells)) {
      return;
    }
    box_ = detail::box_around(box_, Brick::cells_of(brick));
    BrickGrid<Content>::Values& values = contents_.values(contents_.store(brick));
    for_each_offset(cells, [&](std::size_t offset) { values[offset] = Content::Wanted; });
  });
  const auto occupied_in = [&map](const VoxelIndex& brick) {
    const Brick* const known = map.find_brick(brick);
    return known == nullptr ? BrickPlane{} : known->occupied;
  };
  for (std::size_t number = 0; number < contents_.bricks(); ++number) {
    BrickGrid<Content>::Values& values = contents_.values(number);
    const VoxelIndex address = contents_.address(number);
    const BrickPlane occupied = occupied_in(address);
    BrickPlane beside{};
    for (std::size_t axis = 0; axis < detail::kAxes.size(); ++axis) {
      const BrickPlane below = occupied_in(address + kFaceNeighbours[2 * axis]);
      const BrickPlane above = occupied_in(address + kFaceNeighbours[2 * axis + 1]);
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        beside[word] |= detail::from_below(occupied, below, detail::kAxes[axis], word) |
                        detail::from_above(occupied, above, detail::kAxes[axis], word);
      }
    }
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      for_each_offset(beside[word], word, [&](std::size_t offset) {
        values[offset] = values[offset] == Content::Wanted ? Content::WantedBesideSurface : values[offset];
      });
      for_each_offset(occupied[word], word, [&](std::size_t offset) { values[offset] = Content::Surface; });
    }
  }
}

VANTAGE_INLINE std::vector<SightedCell> UnknownSight::look(const RayCaster& caster, const Pose& world_from_sensor,
                                                           const ViewRays& rays, std::uint64_t& operations) const {
  const Eigen::Vector3d sensor = world_from_sensor.translation();
  const Eigen::Vector3d range = Eigen::Vector3d::Constant(rays.max_range_m());
  const VoxelBox near{frame_.cell_of(sensor - range), frame_.cell_of(sensor + range) + VoxelIndex{1, 1, 1}};
  const VoxelBox box = detail::box_overlap(box_, near);
  if (box.empty()) {
    return {};
  }
  std::vector<RayEnd> ends(rays.size());
  caster.cast(world_from_sensor, rays, ends);
  const VoxelIndex here = frame_.cell_of(sensor);
  Reader content_of(*this);
  Chances chances(box, sensor, rays.min_range_m(), frame_);
  for (const RayTile& tile : rays.tiles()) {
    for (std::uint64_t left = tile.rays; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const RayEnd& end = ends[tile.ray[i]];
      chances.operations += detail::cells_between(here, end.cell);
      if (end.occupancy != Occupancy::Unknown || content_of(end.cell) == Content::Open) {
        continue;
      }
      const Eigen::Vector3d direction = (world_from_sensor.linear() * tile.direction(i).cast<double>()).normalized();
      follow({sensor, direction, end.cell, rays.max_range_m()}, content_of, chances);
    }
  }
  operations += chances.operations;
  return chances.cells();
}

VANTAGE_INLINE void UnknownSight::follow(const Ray& ray, Reader& content_of, Chances& chances) const {
  auto& passed = chances.on_ray;
  passed.clear();
  double reached = 1.0;
  bool returns = options_.reports_no_return;
  const auto pass = [&](const VoxelIndex& cell, Content content) {
    if (content != Content::Open) {
      passed.push_back({cell, reached});
      reached *= 1.0 - (content == Content::Wanted ? options_.opaque_share : options_.opaque_beside_surface);
    }
  };
  pass(ray.end, content_of(ray.end));
  // The depth of the cells increases along a ray, so the walk may start anywhere before the cell behind the end.
  const auto depth_of = [&](const VoxelIndex& cell) {
    return ray.direction.dot(frame_.centre_of(cell) - ray.sensor);
  };
  const double end_depth = depth_of(ray.end);
  const double start_m = std::clamp(end_depth - frame_.size_m, 0.0, ray.range_m);
  bool behind = false;
  for (const VoxelIndex& cell :
       VoxelRay(frame_, ray.sensor + start_m * ray.direction, ray.sensor + ray.range_m * ray.direction)) {
    behind = behind || (cell != ray.end && depth_of(cell) > end_depth);
    if (!behind) {
      continue;
    }
    ++chances.operations;
    if (!bounds_.contains(cell) || reached < detail::kLeastChance) {
      break;  // the ray has left the bounding box of the map, or its probability is negligible
    }
    const Content content = content_of(cell);
    if (content == Content::Surface) {
      if (!chances.in_range(cell)) {
        return;
      }
      returns = true;
      break;
    }
    pass(cell, content);
  }
  for (const Chances::Passed& one : passed) {
    // Without a return, the cell is observed only if the ray stops in it or behind it.
    chances.raise(one.cell, returns ? one.reached : one.reached - reached);
  }
}

}  // namespace vantage
