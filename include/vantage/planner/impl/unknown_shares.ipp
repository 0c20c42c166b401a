// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/unknown_shares.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/map/impl/brick_plane.hpp>

namespace vantage::detail {

inline constexpr double kFurthestM = 1e3;
// A box of more bricks is large: a cube of 2 * 13 + 1 bricks along an edge.
inline constexpr std::int32_t kNearBricks = 13;
inline constexpr std::size_t kManyBricks = 27U * 27U * 27U;

inline std::size_t nearest_of(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& to) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const double squared = (points[i] - to).squaredNorm(); squared < least) {
      least = squared;
      nearest = i;
    }
  }
  return nearest;
}

inline std::size_t unknown_in(const OccupancyMap& map, const VoxelIndex& brick) {
  const VoxelBox all{Brick::first_cell(brick), Brick::first_cell(brick + VoxelIndex{1, 1, 1})};
  BrickPlane unknown = plane_of(brick, map.region() ? *map.region() : all);
  if (const Brick* const known = map.find_brick(brick)) {
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      unknown[word] &= ~known->known[word];
    }
  }
  return size_of(unknown);
}

VANTAGE_INLINE std::vector<double> unknown_shares(const OccupancyMap& map, double beyond_m, double seen_m,
                                                  std::span<const VoxelIndex> places) {
  const VoxelBox cells = map.bounds().grown(map.frame().cells_up_to(std::min(beyond_m, kFurthestM)));
  VoxelBox bricks = Brick::over(map.region() ? box_overlap(cells, *map.region()) : cells);
  if (bricks.size() > kManyBricks) {
    bricks = box_overlap(bricks, Brick::over(box_around(places)).grown(kNearBricks));
  }
  std::int32_t step = 1;
  while (bricks.size() / static_cast<std::size_t>(step * step * step) > kManyBricks) {
    ++step;
  }
  std::vector<Eigen::Vector3d> places_m(places.size());
  std::transform(places.begin(), places.end(), places_m.begin(),
                 [&](const VoxelIndex& place) { return map.frame().centre_of(place); });
  const VoxelFrame frame{Brick::kSide * map.resolution_m()};
  std::vector<double> counts(places.size(), 0.0);
  double sum = 0.0;
  for (VoxelIndex brick = bricks.lo; brick.z < bricks.hi.z; brick.z += step) {
    for (brick.y = bricks.lo.y; brick.y < bricks.hi.y; brick.y += step) {
      for (brick.x = bricks.lo.x; brick.x < bricks.hi.x; brick.x += step) {
        if (const auto count = static_cast<double>(unknown_in(map, brick)); count > 0.0) {
          const Eigen::Vector3d at_m = frame.centre_of(brick);
          const std::size_t nearest = nearest_of(places_m, at_m);
          counts[nearest] += (places_m[nearest] - at_m).norm() > seen_m ? count : 0.0;
          sum += count;
        }
      }
    }
  }
  for (double& count : counts) {
    count = sum > 0.0 ? count / sum : 0.0;
  }
  return counts;
}

}  // namespace vantage::detail
