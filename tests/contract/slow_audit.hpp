// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace vantage::testing {

/// Whether all cells that the segment touches, edges included, satisfy `clear`. Iterates over layers across the
/// dominant axis.
template <class Clear>
[[nodiscard]] bool touches_only(const VoxelFrame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                Clear&& clear) {
  constexpr double kHair = 1e-6;  // tolerance, cells
  const Eigen::Vector3d a = from / frame.size_m;
  const Eigen::Vector3d b = to / frame.size_m;
  Eigen::Index axis = 0;
  (b - a).cwiseAbs().maxCoeff(&axis);
  const double low = std::min(a[axis], b[axis]);
  const double high = std::max(a[axis], b[axis]);
  for (double layer = std::floor(low - kHair); layer <= std::floor(high + kHair); layer += 1.0) {
    const auto at = [&](double along) -> Eigen::Vector3d {
      const double share = high > low ? (std::clamp(along, low, high) - a[axis]) / (b[axis] - a[axis]) : 0.0;
      return a + share * (b - a);
    };
    const Eigen::Vector3d p = at(layer);
    const Eigen::Vector3d q = at(layer + 1.0);
    Eigen::Vector3d lo = p.cwiseMin(q).array() - kHair;
    Eigen::Vector3d hi = p.cwiseMax(q).array() + kHair;
    lo[axis] = hi[axis] = layer + 0.5;
    for (double z = std::floor(lo.z()); z <= hi.z(); z += 1.0) {
      for (double y = std::floor(lo.y()); y <= hi.y(); y += 1.0) {
        for (double x = std::floor(lo.x()); x <= hi.x(); x += 1.0) {
          if (!clear(VoxelIndex{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                                static_cast<std::int32_t>(z)})) {
            return false;
          }
        }
      }
    }
  }
  return true;
}

/// The cells to whose centres the platform can go from `current`, by flood fill over admitted cells.
[[nodiscard]] inline std::set<VoxelIndex> places_from(const OccupancyMap& map, const Platform& platform,
                                                      const Pose& current) {
  std::set<VoxelIndex> places;
  std::vector<VoxelIndex> queue;
  const VoxelIndex home = map.frame().cell_of(current.translation());
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(1), [&](const VoxelIndex& cell) {
    Pose there = current;
    there.translation() = map.frame().centre_of(cell);
    if (queue.empty() && platform.admits_cell(map, cell) && platform.admits_motion(map, current, there)) {
      queue.push_back(cell);
      places.insert(cell);
    }
  });
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex cell = queue[next] + step;
      if (platform.admits_cell(map, cell) && places.insert(cell).second) {
        queue.push_back(cell);
      }
    }
  }
  return places;
}

/// What a host knows about a run: its scans, and for each cell the goals from which it was sought.
struct LookedAt {
  struct Look {
    Pose pose;
    OccupancyMap map;  // after the scan
  };
  std::vector<Look> looks;
  std::map<VoxelIndex, std::set<VoxelIndex>> sought;
};

/// Whether two places are alike, as seen from `unknown` (TriedViews).
[[nodiscard]] inline bool alike(const VoxelIndex& unknown, const VoxelIndex& a, const VoxelIndex& b) {
  const auto square = [](const VoxelIndex& d) { return d.x * d.x + d.y * d.y + d.z * d.z; };
  return 4 * square(a - b) <= std::min(square(a - unknown), square(b - unknown));
}

/// Unknown neighbours of free cells that the sensor could still see, from a place that was not the goal of a plan
/// that sought them:
/// - Their centre or the centre of a face, from a place that is not like one from which they were in view. They were
///   not in view from two cells, and not in view or sought from four cells together.
/// - Or their centre, from a place that touches none from which the line is clear in the final map. There are not two
///   such places, and they were not in view or sought from eight cells together.
[[nodiscard]] inline std::vector<VoxelIndex> still_observable(const OccupancyMap& map, const Platform& platform,
                                                              const RangeSensor& sensor, const Pose& current,
                                                              const LookedAt& looked) {
  const VoxelFrame& frame = map.frame();
  const std::set<VoxelIndex> places = places_from(map, platform, current);
  const auto in_range = [&](const Eigen::Vector3d& line) {
    return line.norm() >= sensor.min_range_m && line.norm() <= sensor.max_range_m;
  };
  std::set<VoxelIndex> unknown;
  for_each_cell(map.bounds(), [&](const VoxelIndex& cell) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      if (map.at(cell) == Occupancy::Free && map.in_region(cell + step) &&
          map.at(cell + step) == Occupancy::Unknown) {
        unknown.insert(cell + step);
      }
    }
  });
  std::vector<VoxelIndex> left;
  for (const VoxelIndex& cell : unknown) {
    const Eigen::Vector3d centre = frame.centre_of(cell);
    const auto is_clear = [&](const VoxelIndex& other) { return other == cell || map.at(other) == Occupancy::Free; };
    const auto sought = looked.sought.find(cell);
    const auto in_sight = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& point) {
      return touches_only(frame, from, point, is_clear);
    };
    const auto is_seen_from = [&](const VoxelIndex& place) {
      const Eigen::Vector3d from = frame.centre_of(place);
      const Pose facing = platform.facing(from, centre - from);
      return in_range(centre - from) && sensor.in_view(facing.linear().transpose() * (centre - from)) &&
             platform.admits(map, facing) &&
             (in_sight(from, centre) ||
              std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
                const Eigen::Vector3d out(step.x, step.y, step.z);
                return out.dot(from - centre) > 0.0 && in_sight(from, centre + 0.49 * frame.size_m * out);
              }));
    };
    std::vector<VoxelIndex> viewpoints;
    std::copy_if(places.begin(), places.end(), std::back_inserter(viewpoints), [&](const VoxelIndex& place) {
      return (sought == looked.sought.end() || !sought->second.contains(place)) && is_seen_from(place);
    });
    if (viewpoints.empty()) {
      continue;
    }
    std::set<VoxelIndex> from_cells;
    std::set<VoxelIndex> clear_from;
    for (const auto& [pose, then] : looked.looks) {
      const Eigen::Vector3d line = centre - pose.translation();
      const auto passes = [&](const VoxelIndex& other) {
        const VoxelIndex d = other - cell;
        return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= 1 || then.at(other) == Occupancy::Free;
      };
      if (in_range(line) && sensor.in_view(pose.linear().transpose() * line) &&
          touches_only(frame, pose.translation(), centre, passes)) {
        from_cells.insert(frame.cell_of(pose.translation()));
        if (in_sight(pose.translation(), centre)) {
          clear_from.insert(frame.cell_of(pose.translation()));
        }
      }
    }
    const std::size_t goals = sought == looked.sought.end() ? 0 : sought->second.size();
    const bool differs = std::any_of(viewpoints.begin(), viewpoints.end(), [&](const VoxelIndex& place) {
      return std::none_of(from_cells.begin(), from_cells.end(),
                          [&](const VoxelIndex& other) { return alike(cell, place, other); });
    });
    const bool is_apart = std::any_of(viewpoints.begin(), viewpoints.end(), [&](const VoxelIndex& place) {
      return in_sight(frame.centre_of(place), centre) &&
             std::none_of(clear_from.begin(), clear_from.end(), [&](const VoxelIndex& other) {
               const VoxelIndex d = other - place;
               return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= 1;
             });
    });
    if ((differs && from_cells.size() < 2 && from_cells.size() + goals < 4) ||
        (is_apart && clear_from.size() < 2 && from_cells.size() + goals < 8)) {
      left.push_back(cell);
    }
  }
  return left;
}

}  // namespace vantage::testing
