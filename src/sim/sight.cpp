// SPDX-License-Identifier: MIT
#include "sim/sight.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <vantage/geometry/voxel_ray.hpp>

#include <vantage/raytrace/impl/shared_work.hpp>
#include "sim/pose_plane.hpp"
#include "sim/pose_tree.hpp"

namespace vantage {
namespace {

// Cells that can be seen at all: those joined to a pose through free cells of the region, and the surfaces that bound
// them, because a line of sight goes from face to face. From a pose outside of the region it enters at a border cell.
std::vector<VoxelIndex> candidates(const Sight& sight, const VoxelBox& region, const std::vector<VoxelIndex>& poses) {
  VoxelGrid<std::uint8_t> reached(region, 0);
  std::vector<VoxelIndex> queue;
  bool outside = false;
  for (const VoxelIndex& pose : poses) {
    outside = outside || !reached.contains(pose);
    if (reached.contains(pose) && reached[pose] == 0) {
      reached[pose] = 1;
      queue.push_back(pose);
    }
  }
  if (outside) {
    const VoxelBox inner{region.lo + VoxelIndex{1, 1, 1}, region.hi - VoxelIndex{1, 1, 1}};
    for_each_cell(region, [&](const VoxelIndex& cell) {
      if (!inner.contains(cell) && reached[cell] == 0) {
        reached[cell] = 1;
        if (sight.is_free(cell)) {
          queue.push_back(cell);
        }
      }
    });
  }
  while (!queue.empty()) {
    const VoxelIndex cell = queue.back();
    queue.pop_back();
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex neighbour = cell + step;
      if (reached.contains(neighbour) && reached[neighbour] == 0) {
        reached[neighbour] = 1;
        if (sight.is_free(neighbour)) {
          queue.push_back(neighbour);
        }
      }
    }
  }
  std::vector<VoxelIndex> found;
  for_each_cell(region, [&](const VoxelIndex& cell) {
    if (reached[cell] != 0) {
      found.push_back(cell);
    }
  });
  return found;
}

// By cell: whether a pose sees it. `any(cell, ask)`: whether `ask` is true of one of the poses.
template <class Any>
std::vector<std::uint8_t> seen_by(const Any& any, const Sight& sight, const std::vector<VoxelIndex>& cells,
                                  int threads, const std::function<void(double)>& on_share) {
  std::vector<std::uint8_t> seen(cells.size(), 0);
  constexpr std::size_t kChunk = 1024;
  const std::size_t chunks = (cells.size() + kChunk - 1) / kChunk;
  std::mutex telling;
  std::size_t done = 0;
  detail::share_work(chunks, static_cast<std::size_t>(threads), [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, cells.size()); ++i) {
      seen[i] = any(cells[i], [&](const VoxelIndex& pose) { return sight.sees(pose, cells[i]); }) ? 1 : 0;
    }
    if (on_share) {
      const std::scoped_lock lock(telling);
      on_share(static_cast<double>(++done) / static_cast<double>(chunks));
    }
  });
  return seen;
}

}  // namespace

bool Sight::sees(const VoxelIndex& pose, const VoxelIndex& cell) const {
  return sees_point(pose, cell, frame_.centre_of(cell));
}

bool Sight::sees_part(const VoxelIndex& pose, const VoxelIndex& cell) const {
  constexpr double kInside = 0.49;  // cells from the centre
  if (sees(pose, cell)) {
    return true;
  }
  const Eigen::Vector3d middle = frame_.centre_of(cell);
  const bool one_layer = cells_.box().extent().z == 1;  // points above and below are not in it
  for (const VoxelIndex& part : kAllNeighbours) {
    if ((part.z == 0 || !one_layer) &&
        sees_point(pose, cell, middle + kInside * frame_.size_m * Eigen::Vector3d(part.x, part.y, part.z))) {
      return true;
    }
  }
  return false;
}

bool Sight::sees_point(const VoxelIndex& pose, const VoxelIndex& cell, const Eigen::Vector3d& to) const {
  const Eigen::Vector3d from = frame_.centre_of(pose);
  const double distance_m = (to - from).norm();
  const bool surface = !is_free(cell);
  if (distance_m > sensor_.max_range_m || (surface && distance_m < sensor_.min_range_m)) {
    return false;
  }
  if (!can_tilt_ && pose != cell) {
    const Eigen::Vector3d step = to - from;
    if (!sensor_.in_view({0.0, -step.z(), std::hypot(step.x(), step.y())})) {
      return false;
    }
  }
  // From the cell outwards, because an occluder is usually near the cell.
  for (const VoxelIndex& passed : VoxelRay(frame_, to, from)) {
    if (passed != cell && !is_free(passed)) {
      return false;
    }
  }
  return surface || sensor_.reports_no_return || pose == cell || ends_on_a_surface(from, to);
}

bool Sight::ends_on_a_surface(const Eigen::Vector3d& pose_m, const Eigen::Vector3d& cell_m) const {
  const Eigen::Vector3d end = pose_m + (cell_m - pose_m).normalized() * sensor_.max_range_m;
  for (const VoxelIndex& passed : VoxelRay(frame_, cell_m, end)) {
    if (!cells_.contains(passed)) {
      return false;
    }
    if (!is_free(passed)) {
      return (frame_.centre_of(passed) - pose_m).norm() >= sensor_.min_range_m;
    }
  }
  return false;
}

std::vector<VoxelIndex> seen_cells(const Sight& sight, const VoxelBox& region, const std::vector<VoxelIndex>& poses,
                                   int threads, const std::function<void(double)>& on_share) {
  const std::vector<VoxelIndex> cells = candidates(sight, region, poses);
  const double furthest_cells = sight.sensor().max_range_m / sight.frame().size_m;
  const auto is_solid = [&](const VoxelIndex& cell) { return !sight.is_free(cell); };
  const auto seen = [&] {
    if (!poses.empty() && detail::PosePlane::holds(poses, region)) {
      const detail::PosePlane plane(poses, region, is_solid);
      const auto any = [&](const VoxelIndex& cell, const auto& ask) { return plane.any(cell, furthest_cells, ask); };
      return seen_by(any, sight, cells, threads, on_share);
    }
    const detail::PoseTree tree(poses);
    const auto any = [&](const VoxelIndex& cell, const auto& ask) {
      return tree.any(cell, furthest_cells, is_solid, ask);
    };
    return seen_by(any, sight, cells, threads, on_share);
  }();
  std::vector<VoxelIndex> found;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (seen[i] != 0) {
      found.push_back(cells[i]);
    }
  }
  return found;
}

}  // namespace vantage
