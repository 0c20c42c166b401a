// SPDX-License-Identifier: MIT
#include "apps/exhaustive_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <ostream>
#include <unordered_set>
#include <utility>
#include <vantage/evaluation/cover_bound.hpp>
#include <vantage/evaluation/view_cover.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vantage/view/frontier_survey.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/raytrace/impl/shared_work.hpp>

namespace vantage::apps {
namespace {

double litres_of(std::size_t cells, double cell_m) { return static_cast<double>(cells) * std::pow(10.0 * cell_m, 3); }

// The wanted cells and what they are looked at with.
struct Looking {
  const TriangleScene& scene;
  const RangeSensor& sensor;
  const ViewRays& rays;
  VoxelFrame frame;
  CellSet wanted;
  Box around;  // box of the wanted cells
};

// Distances at which a ray enters and leaves a box, metres; if it misses the box, the first exceeds the second.
std::pair<double, double> way_in(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (box.min - from).array() / direction.array();
  const Eigen::Array3d b = (box.max - from).array() / direction.array();
  return {std::max(0.0, a.min(b).maxCoeff()), a.max(b).minCoeff()};
}

// The wanted cells that a view makes known: those that its rays pass up to the first surface.
CellSet revealed(const Looking& looking, const Pose& pose) {
  const Eigen::Vector3d from = pose.translation();
  CellSet cells(looking.wanted.box());
  for (const RayTile& tile : looking.rays.tiles()) {
    for (std::uint64_t left = tile.rays; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const Eigen::Vector3f ray = tile.direction(i);
      const Eigen::Vector3d direction = (pose.linear() * ray.cast<double>()).normalized();
      const auto [enters_m, leaves_m] = way_in(looking.around, from, direction);
      if (!(enters_m < leaves_m)) {
        continue;
      }
      const double range_m = looking.sensor.max_range_m;
      const std::optional<double> hit_m = looking.scene.hit_distance(from, direction, range_m);
      const bool tells = hit_m ? *hit_m >= looking.sensor.min_range_m : looking.sensor.reports_no_return;
      const double end_m = std::min(leaves_m, hit_m.value_or(range_m));
      if (!tells || end_m <= enters_m) {
        continue;
      }
      for (const VoxelIndex& cell : VoxelRay(looking.frame, from + enters_m * direction, from + end_m * direction)) {
        if (looking.wanted.contains(cell)) {
          cells.insert(cell);
        }
      }
    }
  }
  return cells;
}

// The cells and all wanted cells beside them, corners included.
CellSet grown(const CellSet& cells, const CellSet& wanted) {
  CellSet more(cells.box());
  cells.for_each([&](const VoxelIndex& cell) {
    for_each_cell(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(1), [&](const VoxelIndex& beside) {
      if (wanted.contains(beside)) {
        more.insert(beside);
      }
    });
  });
  return more;
}

CellSet common(const CellSet& a, const CellSet& b) {
  CellSet only_a = a;
  only_a -= b;
  CellSet both = a;
  both -= only_a;
  return both;
}

}  // namespace

std::vector<Pose> exhaustive_poses(const Arm& arm, const OccupancyMap& map, std::size_t most_poses) {
  const std::vector<Pose> admitted = arm.admitted_poses(map);
  const std::size_t stride = admitted.size() / most_poses + 1;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < admitted.size(); i += stride) {
    poses.push_back(admitted[i]);
  }
  return poses;
}

void print_exhaustive(std::ostream& out, const Arm& arm, const RangeSensor& sensor, const OccupancyMap& map) {
  const std::vector<VoxelIndex> voids = void_cells(map);
  if (voids.empty()) {
    out << "  exhaustive   no void cell is left\n";
    return;
  }
  const std::unordered_set<VoxelIndex> is_void(voids.begin(), voids.end());
  const RayCaster caster(map);
  const ViewRays rays(sensor.rays_for(map.resolution_m()));
  std::unordered_set<VoxelIndex> by_any;
  std::size_t best = 0;
  const std::vector<Pose> poses = exhaustive_poses(arm, map);
  for (const Pose& pose : poses) {
    std::size_t seen = 0;
    std::uint64_t operations = 0;
    caster.visible_cells(pose, rays, map.bounds()).for_each([&](const VoxelIndex& cell) {
      if (is_void.contains(cell) && in_plain_sight(map, pose.translation(), cell, operations)) {
        ++seen;
        by_any.insert(cell);
      }
    });
    best = std::max(best, seen);
  }
  char line[240];
  std::snprintf(line, sizeof line,
                "  exhaustive   of %zu void cells left (%.2f dm^3), %zu poses of the arm see %zu (%.2f dm^3) in all, "
                "the best of them %zu (%.2f dm^3)\n",
                voids.size(), litres_of(voids.size(), map.resolution_m()), poses.size(), by_any.size(),
                litres_of(by_any.size(), map.resolution_m()), best, litres_of(best, map.resolution_m()));
  out << line << std::flush;
}

ViewsNeeded views_needed(const Arm& arm, const RangeSensor& sensor, const OccupancyMap& map,
                         const OccupancyMap& truth, const TriangleScene& scene, std::size_t most_poses, int threads) {
  ViewsNeeded needed;
  const std::vector<VoxelIndex> voids = void_cells(map);
  std::vector<Pose> poses = exhaustive_poses(arm, map, most_poses);
  needed.poses_now = poses.size();
  const std::vector<Pose> later = exhaustive_poses(arm, truth, most_poses);
  poses.insert(poses.end(), later.begin(), later.end());
  needed.poses = poses.size();
  const ViewRays rays(sensor.rays_for(0.5 * map.resolution_m()));
  const VoxelBox box = detail::box_around(voids);
  Looking looking{scene, sensor, rays, map.frame(), CellSet(box), map.frame().box_of(box)};
  for (const VoxelIndex& cell : voids) {
    looking.wanted.insert(cell);
  }
  std::vector<CellSet> seen(poses.size());
  detail::share_work(poses.size(), static_cast<std::size_t>(threads),
                     [&](std::size_t i) { seen[i] = revealed(looking, poses[i]); });
  CellSet to_see(box);
  for (std::size_t i = 0; i < needed.poses_now; ++i) {
    to_see |= seen[i];
  }
  needed.to_see = to_see.size();
  std::vector<CellSet> more(poses.size());
  detail::share_work(poses.size(), static_cast<std::size_t>(threads), [&](std::size_t i) {
    more[i] = common(grown(seen[i], looking.wanted), to_see);
    seen[i] = common(seen[i], to_see);
  });
  CellSet left = to_see;
  for (const std::size_t view : cover_views(seen)) {
    left -= seen[view];
    needed.left.push_back(left.size());
  }
  needed.at_least = fewest_views_bound(seen, to_see);
  needed.at_least_if_more_is_seen = fewest_views_bound(more, to_see);
  return needed;
}

void print_views_needed(std::ostream& out, const ViewsNeeded& needed, double cell_m) {
  char line[400];
  std::snprintf(
      line, sizeof line,
      "  bound        after the first view %zu poses of the arm could make %zu void cells known (%.2f dm^3); "
      "knowing all, a greedy choice among %zu poses takes %zu more views, no choice fewer than %.0f, nor than "
      "%.0f if every view made one cell more known all around (%.2f, %.2f)\n"
      "  left         dm^3 after each view of the greedy choice:",
      needed.poses_now, needed.to_see, litres_of(needed.to_see, cell_m), needed.poses, needed.left.size(),
      std::ceil(needed.at_least - 1e-9) + 0.0, std::ceil(needed.at_least_if_more_is_seen - 1e-9) + 0.0,
      needed.at_least, needed.at_least_if_more_is_seen);
  out << line;
  for (const std::size_t cells : needed.left) {
    std::snprintf(line, sizeof line, " %.2f", litres_of(cells, cell_m));
    out << line;
  }
  out << '\n' << std::flush;
}

}  // namespace vantage::apps
