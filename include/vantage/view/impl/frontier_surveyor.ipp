// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/frontier_surveyor.hpp>

#include <vantage/view/impl/sight_memory.hpp>

namespace vantage {
namespace detail {

// Pairs of an unknown and a reachable cell that are tested one by one if the sampled rays find no target.
inline constexpr std::size_t kExhaustivePairs = 3'000'000;

// The range of the sensor, which may be unlimited, bounded by the extent of the known map.
inline double furthest_m(const OccupancyMap& map, const RangeSensor& sensor) {
  return std::min(sensor.max_range_m, map.frame().box_of(map.bounds()).extent().norm() + map.resolution_m());
}

// Searches viewpoints of unknown cells.
class ViewpointSearch {
 public:
  ViewpointSearch(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                  const ReachableSpace& reachable, const TriedViews& tried, detail::SightMemory& memory)
      : map_(map),
        frame_(map.frame()),
        platform_(platform),
        sensor_(sensor),
        reachable_(reachable),
        tried_(tried),
        memory_(memory) {}

  [[nodiscard]] bool is_sought(const VoxelIndex& cell) const {
    return map_.in_region(cell) && map_.at(cell) == Occupancy::Unknown && !tried_.gave_up(cell);
  }
  // The first unknown neighbour of a frontier cell for which `find` returns a viewpoint.
  template <class Find>
  std::optional<FrontierTarget> first_seen(const VoxelIndex& frontier, Find&& find) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex unknown = frontier + step;
      if (const auto viewpoint = is_sought(unknown) ? find(unknown) : std::nullopt) {
        return FrontierTarget{frontier, unknown, *viewpoint};
      }
    }
    return std::nullopt;
  }

  // Searches backwards from `unknown`: first straight through the frontier cell, then along rays in all directions.
  std::optional<VoxelIndex> look_back(const VoxelIndex& unknown, const VoxelIndex& frontier) {
    if (const std::optional<VoxelIndex> straight = look_straight(unknown, frontier - unknown)) {
      return straight;
    }
    if (!can_be_seen(unknown)) {
      return std::nullopt;
    }
    return memory_.look_around(
        unknown, 0, tried_.tried(unknown), [&](const VoxelIndex& cell) { return passes(cell); },
        [&](const VoxelIndex& cell) { return serves(cell, unknown); });
  }
  // Searches backwards from a frontier cell for a viewpoint that sees a part of one of its unknown neighbours.
  std::optional<FrontierTarget> look_back_from(const VoxelIndex& frontier) {
    std::vector<VoxelIndex> steps;
    std::uint32_t about = 0;
    bool any_tried = false;
    for (std::size_t i = 0; i < kFaceNeighbours.size(); ++i) {
      if (is_sought(frontier + kFaceNeighbours[i])) {
        steps.push_back(kFaceNeighbours[i]);
        about |= 1U << i;
        any_tried = any_tried || tried_.tried(frontier + kFaceNeighbours[i]);
      }
    }
    if (steps.empty()) {
      return std::nullopt;
    }
    const auto seen_from = [&](const VoxelIndex& cell) {
      return std::find_if(steps.begin(), steps.end(),
                          [&](const VoxelIndex& step) { return sees_a_part(cell, frontier + step); });
    };
    const std::optional<VoxelIndex> viewpoint = memory_.look_around(
        frontier, about, any_tried, [&](const VoxelIndex& cell) { return passes(cell); },
        [&](const VoxelIndex& cell) { return seen_from(cell) != steps.end(); });
    return viewpoint ? std::optional(FrontierTarget{frontier, frontier + *seen_from(*viewpoint), *viewpoint})
                     : std::nullopt;
  }
  // Tests every reachable cell until `pairs` is used up.
  std::optional<VoxelIndex> try_all(const VoxelIndex& unknown, std::size_t& pairs) {
    return can_be_seen(unknown)
               ? first_place(pairs, [&](const VoxelIndex& cell) { return sees_a_part(cell, unknown); })
               : std::nullopt;
  }
  // The same for lines that pass other unknown cells beside `unknown`: even if a line only cuts a corner of the first
  // one, that becomes known.
  std::optional<FrontierTarget> try_past(const VoxelIndex& unknown, std::size_t& pairs) {
    VoxelIndex before = unknown;
    VoxelIndex first = unknown;
    bool is_before = false;  // whether the next cell is the one before `first`
    const VoxelBox beside = VoxelBox{unknown, unknown + VoxelIndex{1, 1, 1}}.grown(1);
    const auto passes_by = [&](const VoxelIndex& cell) {
      if (passes(cell)) {
        before = std::exchange(is_before, false) ? cell : before;
        return true;
      }
      first = cell;
      is_before = true;
      return beside.contains(cell) && is_sought(cell);
    };
    const auto place = first_place(pairs, [&](const VoxelIndex& cell) {
      return open_towards(cell, unknown) && in_range(cell, unknown) &&
             VoxelRay(frame_, frame_.centre_of(cell), frame_.centre_of(unknown)).all_from_the_end(passes_by) &&
             in_range(cell, first) && can_face(cell, first);
    });
    return place ? std::optional(FrontierTarget{before, first, *place}) : std::nullopt;
  }
  [[nodiscard]] std::uint64_t operations() const { return operations_; }

 private:
  // A line of sight enters a cell through a face (where it touches an edge, VoxelRay also visits a face neighbour).
  bool can_be_seen(const VoxelIndex& unknown) const {
    return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                       [&](const VoxelIndex& step) { return clear(unknown + step); });
  }
  template <class Serves>
  std::optional<VoxelIndex> first_place(std::size_t& pairs, Serves&& serves) {
    if (places_.empty()) {
      places_ = reachable_.cells();
    }
    for (const VoxelIndex& cell : places_) {
      if (pairs == 0) {
        return std::nullopt;
      }
      --pairs;
      if (memory_.is_reachable(cell) && serves(cell)) {
        return cell;
      }
    }
    return std::nullopt;
  }
  bool clear(const VoxelIndex& cell) const { return memory_.is_clear(cell); }
  bool passes(const VoxelIndex& cell) {
    ++operations_;
    return clear(cell);
  }

  // Along an axis, the line of sight is the row of cells visited so far, so it needs no ray.
  std::optional<VoxelIndex> look_straight(const VoxelIndex& unknown, const VoxelIndex& step) {
    const Eigen::Vector3d direction(step.x, step.y, step.z);
    const VoxelIndex last = frame_.cell_of(frame_.centre_of(unknown) + memory_.furthest_m() * direction);
    for (VoxelIndex cell = unknown; cell != last;) {
      cell = cell + step;
      if (!passes(cell)) {
        return std::nullopt;
      }
      if (memory_.is_reachable(cell) && in_range(cell, unknown) && can_face(cell, unknown)) {
        return cell;
      }
    }
    return std::nullopt;
  }

  // Cheap tests first. Most pairs fail beside the unknown cell.
  bool serves(const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
    return open_towards(viewpoint, unknown) && in_range(viewpoint, unknown) &&
           in_sight(viewpoint, unknown, frame_.centre_of(unknown)) && can_face(viewpoint, unknown);
  }
  // As `serves`, also where a line to the centre of a face is clear.
  bool sees_a_part(const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
    return open_towards(viewpoint, unknown) && in_range(viewpoint, unknown) && can_face(viewpoint, unknown) &&
           (in_sight(viewpoint, unknown, frame_.centre_of(unknown)) ||
            std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
              return faces(viewpoint, unknown, step) && clear(unknown + step) &&
                     in_sight(viewpoint, unknown, just_inside(unknown, step));
            }));
  }
  static bool faces(const VoxelIndex& viewpoint, const VoxelIndex& unknown, const VoxelIndex& step) {
    const VoxelIndex away = viewpoint - unknown;
    return away.x * step.x + away.y * step.y + away.z * step.z > 0;
  }
  // A point of the cell just behind the centre of its face towards `step`.
  [[nodiscard]] Eigen::Vector3d just_inside(const VoxelIndex& cell, const VoxelIndex& step) const {
    return frame_.centre_of(cell) + 0.49 * frame_.size_m * Eigen::Vector3d(step.x, step.y, step.z);
  }
  bool in_sight(const VoxelIndex& viewpoint, const VoxelIndex& unknown, const Eigen::Vector3d& point) {
    return VoxelRay(frame_, frame_.centre_of(viewpoint), point).all_from_the_end([&](const VoxelIndex& cell) {
      return passes(cell) || cell == unknown;
    });
  }
  // Whether a line of sight from `viewpoint` can enter `unknown` through a clear neighbour on its side.
  bool open_towards(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    const VoxelIndex away = viewpoint - unknown;
    return (away.x != 0 && clear(unknown + VoxelIndex{away.x > 0 ? 1 : -1, 0, 0})) ||
           (away.y != 0 && clear(unknown + VoxelIndex{0, away.y > 0 ? 1 : -1, 0})) ||
           (away.z != 0 && clear(unknown + VoxelIndex{0, 0, away.z > 0 ? 1 : -1}));
  }
  bool in_range(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    const double range_m = (frame_.centre_of(unknown) - frame_.centre_of(viewpoint)).norm();
    return range_m >= sensor_.min_range_m && range_m <= sensor_.max_range_m;
  }
  bool can_face(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    const Eigen::Vector3d from = frame_.centre_of(viewpoint);
    const Eigen::Vector3d line = frame_.centre_of(unknown) - from;
    return !tried_.tried_from(unknown, viewpoint) &&
           (platform_.can_tilt() || sensor_.in_view(platform_.facing(from, line).linear().transpose() * line));
  }

  const OccupancyMap& map_;
  VoxelFrame frame_;
  const Platform& platform_;
  const RangeSensor& sensor_;
  const ReachableSpace& reachable_;
  const TriedViews& tried_;
  detail::SightMemory& memory_;
  std::vector<VoxelIndex> places_;  // all reachable cells, listed when they are first needed
  std::uint64_t operations_ = 0;
};

// Whether an unknown neighbour of the frontier cell was given up.
inline bool looked_at_in_vain(const OccupancyMap& map, const VoxelIndex& cell, const TriedViews& tried) {
  return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
    const VoxelIndex unknown = cell + step;
    return map.in_region(unknown) && map.at(unknown) == Occupancy::Unknown && tried.gave_up(unknown);
  });
}

// The first target found along lines past other unknown cells.
inline std::optional<FrontierTarget> one_seen_past_another(ViewpointSearch& search,
                                                           const std::vector<VoxelIndex>& hidden,
                                                           std::size_t& pairs) {
  for (const VoxelIndex& cell : hidden) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      if (const auto past = search.is_sought(cell + step) ? search.try_past(cell + step, pairs) : std::nullopt) {
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

// The sampled rays may miss a viewpoint, so Explored requires that all pairs are tested, if they are not too many.
inline void take_any_seen(ViewpointSearch& search, std::vector<VoxelIndex>& hidden, FrontierSurvey& survey) {
  std::size_t pairs = kExhaustivePairs;
  take_seen(hidden, survey.targets, [&](const VoxelIndex& cell) {
    return search.first_seen(cell, [&](const VoxelIndex& unknown) { return search.try_all(unknown, pairs); });
  });
  const auto past = survey.targets.empty() ? one_seen_past_another(search, hidden, pairs) : std::nullopt;
  if (past) {
    survey.targets.push_back(*past);
    std::erase(hidden, past->frontier);
  }
  survey.exhausted = pairs > 0;
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
      memory_(std::make_unique<detail::SightMemory>()) {}
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

VANTAGE_INLINE FrontierSurvey survey_frontiers(const OccupancyMap& map, const Platform& platform,
                                               const RangeSensor& sensor, const Pose& current,
                                               const FrontierSurveyOptions& options, const TriedViews& tried) {
  const std::shared_ptr<const Platform> borrowed(std::shared_ptr<void>(), &platform);
  return FrontierSurveyor(borrowed, sensor, options).survey(map, current, tried, frontier_cells(map));
}

}  // namespace vantage
