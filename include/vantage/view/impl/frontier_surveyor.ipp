// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/frontier_surveyor.hpp>

#include <vantage/view/impl/can_face.hpp>
#include <vantage/view/impl/sight_memory.hpp>
#include <vantage/view/impl/viewpoint_search.hpp>

namespace vantage {
namespace detail {

// Cells that one survey visits at most, in about ten seconds, if the sampled rays find no target. A house of 10 m in
// cells of 0.1 m needs a tenth of it.
inline constexpr std::uint64_t kMostOperations = 1'000'000'000;
// The limit for cells that can only be seen in part, or only past others: a look makes little of them known.
inline constexpr std::uint64_t kMostOperationsForParts = 10'000'000;

// The range of the sensor, which may be unlimited, bounded by the extent of the known map.
inline double furthest_m(const OccupancyMap& map, const RangeSensor& sensor) {
  return std::min(sensor.max_range_m, map.frame().box_of(map.bounds()).extent().norm() + map.resolution_m());
}

// The sensor's field of view, as wide as rounding may make it. A platform that cannot tilt takes the same orientation
// towards a direction everywhere.
inline SightTree::MayFace widest_view(std::shared_ptr<const Platform> platform, const RangeSensor& sensor) {
  constexpr double kOffAxis = 1.0 - 1e-6;
  return [platform = std::move(platform), sensor](const Eigen::Vector3d& line) {
    return can_face(*platform, sensor, Eigen::Vector3d::Zero(), line, kOffAxis);
  };
}

// Whether an unknown neighbour of the frontier cell was given up.
inline bool looked_at_in_vain(const OccupancyMap& map, const VoxelIndex& cell, const TriedViews& tried) {
  return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
    const VoxelIndex unknown = cell + step;
    return map.in_region(unknown) && map.at(unknown) == Occupancy::Unknown && tried.gave_up(unknown);
  });
}

// The first target found along lines past other unknown cells.
inline std::optional<FrontierTarget> one_seen_past_another(ViewpointSearch& search,
                                                           const std::vector<VoxelIndex>& hidden) {
  for (const VoxelIndex& cell : hidden) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      if (const auto past = search.is_sought(cell + step) ? search.try_past(cell + step) : std::nullopt) {
        return past;
      }
    }
  }
  return std::nullopt;
}

// Moves the cells for which `find` returns a target from `hidden` to `targets`.
template <class Find>
void take_seen(std::vector<VoxelIndex>& hidden, std::vector<FrontierTarget>& targets, Find&& find) {
  std::erase_if(hidden, [&](const VoxelIndex& cell) {
    const std::optional<FrontierTarget> target = find(cell);
    if (target) {
      targets.push_back(*target);
    }
    return target.has_value();
  });
}

// The sampled rays may miss a viewpoint, so Explored requires that all places are tested.
inline void take_any_seen(ViewpointSearch& search, std::vector<VoxelIndex>& hidden, FrontierSurvey& survey) {
  search.limit_to(kMostOperations);
  const auto try_all = [&](const VoxelIndex& cell) {
    return search.first_seen(cell, [&](const VoxelIndex& unknown) { return search.try_all(unknown); });
  };
  const auto try_parts = [&](const VoxelIndex& cell) {
    return search.first_seen(cell, [&](const VoxelIndex& unknown) { return search.try_parts(unknown); });
  };
  take_seen(hidden, survey.targets, try_all);
  survey.exhausted = !search.used_up();
  if (survey.targets.empty()) {
    search.limit_to(kMostOperationsForParts);
    take_seen(hidden, survey.targets, try_parts);
  }
  const auto past = survey.targets.empty() ? one_seen_past_another(search, hidden) : std::nullopt;
  if (past) {
    survey.targets.push_back(*past);
    std::erase(hidden, past->frontier);
  }
}

// The targets whose unknown cell touches an occupied cell; all targets if there is none.
inline std::vector<FrontierTarget> surfaces_first(const OccupancyMap& map, std::vector<FrontierTarget> targets) {
  const auto beside_surface = [&](const FrontierTarget& target) {
    return std::any_of(kAllNeighbours.begin(), kAllNeighbours.end(),
                       [&](const VoxelIndex& step) { return map.at(target.unknown + step) == Occupancy::Occupied; });
  };
  std::vector<FrontierTarget> beside;
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(beside), beside_surface);
  return beside.empty() ? std::move(targets) : beside;
}

// Assigns each frontier cell without target to a cause. The platform comes close to a cell if a reachable cell lies
// within half the largest side of its body plus one cell.
inline void count_hidden(const OccupancyMap& map, const Platform& platform, const ReachableSpace& reachable,
                         const TriedViews& tried, const std::vector<VoxelIndex>& hidden, Leftover& leftover) {
  const Eigen::Vector3d half = 0.5 * platform.body_box(Pose::Identity()).extent();
  const std::int32_t near = map.frame().cells_up_to(half.maxCoeff()) + 1;
  for (const VoxelIndex& cell : hidden) {
    const bool comes_close = reachable.any_in(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(near));
    ++(looked_at_in_vain(map, cell, tried) ? leftover.in_vain
       : comes_close                       ? leftover.unobservable
                                           : leftover.unreachable);
  }
}

}  // namespace detail

VANTAGE_INLINE FrontierSurveyor::FrontierSurveyor(std::shared_ptr<const Platform> platform, const RangeSensor& sensor,
                                                  const FrontierSurveyOptions& options)
    : platform_(std::move(platform)),
      sensor_(sensor),
      options_(options),
      memory_(std::make_unique<detail::SightMemory>(detail::widest_view(platform_, sensor))) {}
VANTAGE_INLINE FrontierSurveyor::FrontierSurveyor(FrontierSurveyor&&) noexcept = default;
VANTAGE_INLINE FrontierSurveyor& FrontierSurveyor::operator=(FrontierSurveyor&&) noexcept = default;
VANTAGE_INLINE FrontierSurveyor::~FrontierSurveyor() = default;

VANTAGE_INLINE FrontierSurvey FrontierSurveyor::survey(const OccupancyMap& map, const Pose& current,
                                                       const TriedViews& tried,
                                                       const std::vector<VoxelIndex>& frontier) {
  reachable_.follow(map, *platform_, current);
  return find_targets(map, tried, frontier);
}

VANTAGE_INLINE FrontierSurvey FrontierSurveyor::survey_from(const std::vector<VoxelIndex>& places,
                                                            const OccupancyMap& map, const TriedViews& tried,
                                                            const std::vector<VoxelIndex>& frontier) {
  reachable_ = ReachableSpace(map.frame(), places);
  return find_targets(map, tried, frontier);
}

// The findings for all frontier cells: those of the last survey where they still hold, else those of
// `search(frontier cell)`.
template <class Search>
std::vector<FrontierSurveyor::Finding> FrontierSurveyor::find_each(const TriedViews& tried,
                                                                   const std::vector<VoxelIndex>& frontier,
                                                                   Search&& search) {
  const std::vector<Finding> before = std::exchange(findings_, {});
  std::vector<Finding> found;
  found.reserve(frontier.size());
  auto last = before.begin();
  for (const VoxelIndex& cell : frontier) {
    const bool is_lasting = std::none_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                                         [&](const VoxelIndex& step) { return tried.tried(cell + step); });
    last = std::find_if(last, before.end(), [&](const Finding& one) { return !RasterOrder{}(one.frontier, cell); });
    const bool holds = last != before.end() && last->frontier == cell && last->is_lasting && is_lasting &&
                       !memory_->may_differ(cell);
    found.push_back(holds ? *last : Finding{cell, search(cell), is_lasting});
  }
  return found;
}

VANTAGE_INLINE FrontierSurvey FrontierSurveyor::find_targets(const OccupancyMap& map, const TriedViews& tried,
                                                             const std::vector<VoxelIndex>& frontier) {
  memory_->follow(map, reachable_, tried, detail::furthest_m(map, sensor_), options_.sight_directions);
  FrontierSurvey survey;
  survey.frontier_cells = frontier.size();
  if (frontier.empty() || !reachable_.start()) {
    findings_.clear();
    survey.leftover.unreachable = frontier.size();
    return survey;
  }
  detail::ViewpointSearch search(map, *platform_, sensor_, reachable_, tried, *memory_);
  // A sensor that looks all around sees parts of cells in passing; a camera would have to be aimed at each.
  const bool takes_parts = sensor_.looks_all_around();
  std::vector<Finding> findings = find_each(tried, frontier, [&](const VoxelIndex& cell) {
    const auto whole =
        search.first_seen(cell, [&](const VoxelIndex& unknown) { return search.look_back(unknown, cell); });
    return whole || !takes_parts ? whole : search.look_back_from(cell);
  });
  std::vector<VoxelIndex> hidden;
  for (const Finding& one : findings) {
    if (one.target) {
      survey.targets.push_back(*one.target);
    } else {
      hidden.push_back(one.frontier);
    }
  }
  if (survey.targets.empty() && !takes_parts) {
    detail::take_seen(hidden, survey.targets, [&](const VoxelIndex& cell) { return search.look_back_from(cell); });
  }
  memory_->forget_others();
  findings_ = std::move(findings);
  if (survey.targets.empty()) {
    detail::take_any_seen(search, hidden, survey);
  }
  if (!sensor_.reports_no_return) {
    survey.targets = detail::surfaces_first(map, std::move(survey.targets));
  }
  survey.ray_operations = search.operations();
  detail::count_hidden(map, *platform_, reachable_, tried, hidden, survey.leftover);
  return survey;
}

VANTAGE_INLINE std::vector<FrontierTarget> FrontierSurveyor::looks_to_take_closely(
    const OccupancyMap& map, const TriedViews& tried, const std::vector<VoxelIndex>& frontier) {
  std::vector<FrontierTarget> targets;
  if (!reachable_.start()) {
    return targets;
  }
  detail::ViewpointSearch search(map, *platform_, sensor_, reachable_, tried, *memory_);
  search.look_closely();
  search.limit_to(detail::kMostOperations);
  for (const VoxelIndex& cell : frontier) {
    if (const auto target =
            search.first_seen(cell, [&](const VoxelIndex& unknown) { return search.try_all(unknown); })) {
      targets.push_back(*target);
    }
  }
  return targets;
}

VANTAGE_INLINE FrontierSurvey survey_frontiers(const OccupancyMap& map, const Platform& platform,
                                               const RangeSensor& sensor, const Pose& current,
                                               const FrontierSurveyOptions& options, const TriedViews& tried) {
  const std::shared_ptr<const Platform> borrowed(std::shared_ptr<void>(), &platform);
  return FrontierSurveyor(borrowed, sensor, options).survey(map, current, tried, frontier_cells(map));
}

}  // namespace vantage
