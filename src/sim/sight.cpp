// SPDX-License-Identifier: MIT
#include "sim/sight.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vantage/geometry/voxel_ray.hpp>

#include "raytrace/shared_work.hpp"

namespace vantage {
namespace {

// Only cells joined to a pose through free cells, and the surfaces that bound them, can be seen at all: a walk along
// a line of sight goes from face to face.
std::vector<VoxelIndex> candidates(const Sight& sight, const VoxelBox& region, const std::vector<VoxelIndex>& poses) {
  VoxelGrid<std::uint8_t> reached(region, 0);
  std::vector<VoxelIndex> queue;
  for (const VoxelIndex& pose : poses) {
    if (reached.contains(pose) && reached[pose] == 0) {
      reached[pose] = 1;
      queue.push_back(pose);
    }
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

// The poses in blocks of space, so that those near a cell are asked first: nearly every cell is seen from one of
// them.
class PoseBlocks {
 public:
  PoseBlocks(const VoxelBox& region, const std::vector<VoxelIndex>& poses)
      : blocks_({block_of(region.lo), block_of(region.hi) + VoxelIndex{1, 1, 1}}) {
    for (const VoxelIndex& pose : poses) {
      blocks_[block_of(pose)].push_back(pose);
    }
  }

  // Calls `ask(pose)` for the poses in growing cubic shells about the cell until one says true; whether one did.
  template <class Ask>
  bool any_from_near(const VoxelIndex& cell, std::int32_t furthest_cells, Ask&& ask) const {
    const VoxelIndex home = block_of(cell);
    const std::int32_t shells = furthest_cells / kEdge + 1;
    for (std::int32_t shell = 0; shell <= shells; ++shell) {
      for (std::int32_t z = -shell; z <= shell; ++z) {
        for (std::int32_t y = -shell; y <= shell; ++y) {
          const bool face = std::abs(z) == shell || std::abs(y) == shell;
          for (std::int32_t x = -shell; x <= shell; x += face || shell == 0 ? 1 : 2 * shell) {
            const VoxelIndex block = home + VoxelIndex{x, y, z};
            if (blocks_.contains(block) && std::any_of(blocks_[block].begin(), blocks_[block].end(), ask)) {
              return true;
            }
          }
        }
      }
      if (holds_all_blocks(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(shell))) {
        return false;
      }
    }
    return false;
  }

 private:
  static constexpr std::int32_t kEdge = 8;
  static VoxelIndex block_of(const VoxelIndex& cell) {
    const auto down = [](std::int32_t value) { return value >= 0 ? value / kEdge : -((kEdge - 1 - value) / kEdge); };
    return {down(cell.x), down(cell.y), down(cell.z)};
  }
  bool holds_all_blocks(const VoxelBox& cube) const {
    const VoxelBox& all = blocks_.box();
    return cube.lo.x <= all.lo.x && cube.lo.y <= all.lo.y && cube.lo.z <= all.lo.z && cube.hi.x >= all.hi.x &&
           cube.hi.y >= all.hi.y && cube.hi.z >= all.hi.z;
  }

  VoxelGrid<std::vector<VoxelIndex>> blocks_;
};

}  // namespace

bool Sight::sees(const VoxelIndex& pose, const VoxelIndex& cell) const {
  return sees_point(pose, cell, frame_.centre_of(cell));
}

bool Sight::sees_part(const VoxelIndex& pose, const VoxelIndex& cell) const {
  constexpr double kInside = 0.49;  // cells from the middle
  if (sees(pose, cell)) {
    return true;
  }
  const Eigen::Vector3d middle = frame_.centre_of(cell);
  for (const VoxelIndex& part : kAllNeighbours) {
    if (sees_point(pose, cell, middle + kInside * frame_.size_m * Eigen::Vector3d(part.x, part.y, part.z))) {
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
  // From the cell outwards: what hides it is usually near it.
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
                                   int threads) {
  const std::vector<VoxelIndex> cells = candidates(sight, region, poses);
  const PoseBlocks blocks(region, poses);
  const auto furthest =
      static_cast<std::int32_t>(std::min(1e6, sight.sensor().max_range_m / sight.frame().size_m)) + 1;
  std::vector<std::uint8_t> seen(cells.size(), 0);
  constexpr std::size_t kChunk = 1024;
  const std::size_t chunks = (cells.size() + kChunk - 1) / kChunk;
  detail::share_work(chunks, static_cast<std::size_t>(threads), [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, cells.size()); ++i) {
      const auto ask = [&](const VoxelIndex& pose) { return sight.sees(pose, cells[i]); };
      seen[i] = blocks.any_from_near(cells[i], furthest, ask) ? 1 : 0;
    }
  });
  std::vector<VoxelIndex> found;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (seen[i] != 0) {
      found.push_back(cells[i]);
    }
  }
  return found;
}

}  // namespace vantage
