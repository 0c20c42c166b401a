// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/planner/frontier_survey.hpp>

#include "geometry/block_counts.hpp"
#include "geometry/cell_rows.hpp"
#include "geometry/spread_directions.hpp"
#include "planner/sight_tree.hpp"

namespace vantage {
namespace {

// The cells that sight passes: a survey asks for them millions of times.
detail::CellRows clear_cells(const OccupancyMap& map) {
  detail::CellRows clear(map.bounds());
  map.for_each_clear([&](const VoxelIndex& cell) { clear.insert(cell); });
  return clear;
}

detail::CellRows rows_of(const ReachableSpace& reachable, const VoxelBox& box) {
  detail::CellRows rows(box);
  for (const VoxelIndex& cell : reachable.cells()) {
    rows.insert(cell);
  }
  return rows;
}

// No further than the known part of the map can reach: a sensor's range may be without bound.
double furthest_m(const OccupancyMap& map, const VoxelBox& bounds, const RangeSensor& sensor) {
  return std::min(sensor.max_range_m, map.frame().box_of(bounds).extent().norm() + map.resolution_m());
}

// Finds a viewpoint for one unknown cell after another.
class ViewpointSearch {
 public:
  ViewpointSearch(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                  const ReachableSpace& reachable, const detail::CellRows& reachable_rows, const FailedViews& failed,
                  std::size_t direction_count)
      : frame_(map.frame()),
        platform_(platform),
        sensor_(sensor),
        reachable_(reachable),
        reachable_rows_(reachable_rows),
        failed_(failed),
        clear_(clear_cells(map)),
        places_(clear_.box(), reachable.cells()),
        furthest_m_(furthest_m(map, clear_.box(), sensor)),
        tree_(frame_, detail::spread_directions(direction_count), furthest_m_) {}

  // Looks back from `unknown`, first straight away through the frontier cell, then all around.
  std::optional<VoxelIndex> look_back(const VoxelIndex& unknown, const VoxelIndex& frontier) {
    if (!can_be_seen(unknown)) {
      return std::nullopt;
    }
    const Eigen::Vector3d centre = frame_.centre_of(unknown);
    const Eigen::Vector3d straight = (frame_.centre_of(frontier) - centre).normalized();
    for (const VoxelIndex& cell : VoxelRay(frame_, centre, centre + furthest_m_ * straight)) {
      if (cell == unknown) {
        continue;
      }
      if (!passes(cell)) {
        break;
      }
      if (is_viewpoint(cell, unknown)) {
        return cell;
      }
    }
    return look_around(unknown);
  }
  // Tries every reachable cell, while there are pairs left to try.
  std::optional<VoxelIndex> try_all(const VoxelIndex& unknown, std::size_t& pairs) {
    if (!can_be_seen(unknown)) {
      return std::nullopt;
    }
    for (const VoxelIndex& cell : reachable_.cells()) {
      if (pairs == 0) {
        return std::nullopt;
      }
      --pairs;
      if (serves(cell, unknown)) {
        return cell;
      }
    }
    return std::nullopt;
  }
  [[nodiscard]] std::uint64_t operations() const { return operations_; }

 private:
  // A line of sight enters a cell by a face (where it grazes an edge, VoxelRay crosses a face neighbour, too).
  bool can_be_seen(const VoxelIndex& unknown) const {
    return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                       [&](const VoxelIndex& step) { return clear(unknown + step); });
  }
  bool clear(const VoxelIndex& cell) const { return clear_.contains(cell); }
  bool passes(const VoxelIndex& cell) {
    ++operations_;
    return clear(cell);
  }
  bool is_viewpoint(const VoxelIndex& cell, const VoxelIndex& unknown) {
    return reachable_rows_.contains(cell) && serves(cell, unknown);
  }

  // The same from whichever frontier cell it is asked.
  std::optional<VoxelIndex> look_around(const VoxelIndex& unknown) {
    const auto [known, is_new] = looked_around_.try_emplace(unknown);
    if (is_new) {
      known->second = tree_.first(
          unknown, [&](const VoxelBox& cells) { return places_.may_hold(cells); },
          [&](const VoxelIndex& cell) { return passes(cell); },
          [&](const VoxelIndex& cell) { return is_viewpoint(cell, unknown); });
    }
    return known->second;
  }

  // The tests are in the order of their price: most pairs fail beside the unknown cell.
  bool serves(const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
    if (!open_towards(viewpoint, unknown)) {
      return false;
    }
    const Eigen::Vector3d from = frame_.centre_of(viewpoint);
    const Eigen::Vector3d line = frame_.centre_of(unknown) - from;
    const double range_m = line.norm();
    if (range_m < sensor_.min_range_m || range_m > sensor_.max_range_m) {
      return false;
    }
    const bool in_sight =
        VoxelRay(frame_, from, frame_.centre_of(unknown)).all_from_the_end([&](const VoxelIndex& cell) {
          return passes(cell) || cell == unknown;
        });
    return in_sight && !failed_.failed_from(unknown, viewpoint) &&
           (platform_.can_tilt() || sensor_.in_view(platform_.facing(from, line).linear().transpose() * line));
  }

  // Whether a line of sight from `viewpoint` could enter `unknown` by one of the faces turned to it.
  bool open_towards(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    const VoxelIndex away = viewpoint - unknown;
    return (away.x != 0 && clear(unknown + VoxelIndex{away.x > 0 ? 1 : -1, 0, 0})) ||
           (away.y != 0 && clear(unknown + VoxelIndex{0, away.y > 0 ? 1 : -1, 0})) ||
           (away.z != 0 && clear(unknown + VoxelIndex{0, 0, away.z > 0 ? 1 : -1}));
  }

  VoxelFrame frame_;
  const Platform& platform_;
  const RangeSensor& sensor_;
  const ReachableSpace& reachable_;
  const detail::CellRows& reachable_rows_;
  const FailedViews& failed_;
  detail::CellRows clear_;
  detail::BlockCounts places_;  // that are reachable
  double furthest_m_;
  detail::SightTree tree_;
  std::unordered_map<VoxelIndex, std::optional<VoxelIndex>> looked_around_;
  std::uint64_t operations_ = 0;
};

std::vector<VoxelIndex> unknown_neighbours(const OccupancyMap& map, const VoxelIndex& cell,
                                           const FailedViews& failed) {
  std::vector<VoxelIndex> unknown;
  for (const VoxelIndex& step : kFaceNeighbours) {
    const VoxelIndex neighbour = cell + step;
    if (map.in_region(neighbour) && map.at(neighbour) == Occupancy::Unknown && !failed.gave_up(neighbour)) {
      unknown.push_back(neighbour);
    }
  }
  return unknown;
}

bool near_contested(const OccupancyMap& map, const std::vector<VoxelIndex>& cluster) {
  return std::any_of(cluster.begin(), cluster.end(), [&](const VoxelIndex& cell) {
    bool found = false;
    for_each_cell(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(2),
                  [&](const VoxelIndex& other) { found = found || map.contested(other); });
    return found;
  });
}

// The targets in clusters that are worth a view.
std::vector<FrontierTarget> large_clusters(const OccupancyMap& map, const FrontierSurveyOptions& options,
                                           const std::vector<FrontierTarget>& targets) {
  std::vector<VoxelIndex> cells;
  cells.reserve(targets.size());
  for (const FrontierTarget& target : targets) {
    cells.push_back(target.frontier);
  }
  std::unordered_set<VoxelIndex> small;
  for (const std::vector<VoxelIndex>& cluster : frontier_clusters(cells)) {
    if (cluster.size() < options.min_cluster_cells ||
        (cluster.size() < options.min_contested_cluster_cells && near_contested(map, cluster))) {
      small.insert(cluster.begin(), cluster.end());
    }
  }
  std::vector<FrontierTarget> large;
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(large),
               [&](const FrontierTarget& target) { return !small.contains(target.frontier); });
  return large;
}

// The targets beside a known surface; all of them if there is none.
std::vector<FrontierTarget> surfaces_first(const OccupancyMap& map, std::vector<FrontierTarget> targets) {
  std::vector<FrontierTarget> beside;
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(beside), [&](const FrontierTarget& target) {
    return std::any_of(kAllNeighbours.begin(), kAllNeighbours.end(),
                       [&](const VoxelIndex& step) { return map.at(target.unknown + step) == Occupancy::Occupied; });
  });
  return beside.empty() ? std::move(targets) : beside;
}

// Where the platform comes close: some reachable cell lies within half its body, and one cell more.
detail::CellRows near_body(const OccupancyMap& map, const Platform& platform, const detail::CellRows& reachable) {
  const Eigen::Vector3d half = 0.5 * platform.body_box(Pose::Identity()).extent();
  return detail::grown(reachable, static_cast<std::int32_t>(std::ceil(half.maxCoeff() / map.resolution_m())) + 1);
}

}  // namespace

FrontierSurvey survey_frontiers(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                                const Pose& current, const FrontierSurveyOptions& options,
                                const FailedViews& failed) {
  return survey_frontiers(map, platform, sensor, current, options, failed, frontier_cells(map));
}

FrontierSurvey survey_frontiers(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                                const Pose& current, const FrontierSurveyOptions& options, const FailedViews& failed,
                                std::vector<VoxelIndex> frontier) {
  FrontierSurvey survey{.reachable = ReachableSpace(map, platform, current)};
  survey.frontier_cells = frontier.size();

  const detail::CellRows reachable = rows_of(survey.reachable, map.bounds());
  std::vector<VoxelIndex> hidden;
  if (!frontier.empty() && survey.reachable.start()) {
    ViewpointSearch search(map, platform, sensor, survey.reachable, reachable, failed, options.sight_directions);
    const auto try_to_see = [&](const VoxelIndex& cell, auto&& find) {
      for (const VoxelIndex& unknown : unknown_neighbours(map, cell, failed)) {
        if (const std::optional<VoxelIndex> viewpoint = find(unknown)) {
          survey.targets.push_back({cell, unknown, *viewpoint});
          return true;
        }
      }
      return false;
    };
    for (const VoxelIndex& cell : frontier) {
      if (!try_to_see(cell, [&](const VoxelIndex& unknown) { return search.look_back(unknown, cell); })) {
        hidden.push_back(cell);
      }
    }
    std::vector<FrontierTarget> large = large_clusters(map, options, survey.targets);
    if (large.empty()) {
      // Nothing may be called explored on the strength of a sample of directions, where all of them can be tried.
      std::size_t pairs = options.exhaustive_pairs;
      std::erase_if(hidden, [&](const VoxelIndex& cell) {
        return try_to_see(cell, [&](const VoxelIndex& unknown) { return search.try_all(unknown, pairs); });
      });
      survey.exhausted = pairs > 0;
      std::sort(survey.targets.begin(), survey.targets.end(), [](const FrontierTarget& a, const FrontierTarget& b) {
        return RasterOrder{}(a.frontier, b.frontier);
      });
      large = large_clusters(map, options, survey.targets);
    }
    survey.leftover.too_small = survey.targets.size() - large.size();
    survey.targets = options.surfaces_first && !sensor.reports_no_return ? surfaces_first(map, std::move(large))
                                                                         : std::move(large);
    survey.ray_operations = search.operations();
  } else {
    hidden = std::move(frontier);
  }
  if (!hidden.empty()) {
    const detail::CellRows near = near_body(map, platform, reachable);
    for (const VoxelIndex& cell : hidden) {
      ++(near.contains(cell) ? survey.leftover.unobservable : survey.leftover.unreachable);
    }
  }
  return survey;
}

bool in_plain_sight(const OccupancyMap& map, const Eigen::Vector3d& from, const VoxelIndex& target,
                    std::uint64_t& operations) {
  for (const VoxelIndex& cell : VoxelRay(map.frame(), from, map.frame().centre_of(target))) {
    ++operations;
    if (cell != target && !map.is_clear(cell)) {
      return false;
    }
  }
  return true;
}

bool sees(const OccupancyMap& map, const RangeSensor& sensor, const Pose& pose, const VoxelIndex& unknown,
          std::uint64_t& operations) {
  const Eigen::Vector3d line = map.frame().centre_of(unknown) - pose.translation();
  const double range_m = line.norm();
  return range_m >= sensor.min_range_m && range_m <= sensor.max_range_m &&
         sensor.in_view(pose.linear().transpose() * line) &&
         in_plain_sight(map, pose.translation(), unknown, operations);
}

}  // namespace vantage
