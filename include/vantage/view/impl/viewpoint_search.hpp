// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/tried_views.hpp>
#include <vector>

#include <vantage/view/impl/sight_memory.hpp>

namespace vantage::detail {

/// Searches places from which the sensor would see unknown cells, for one survey (FrontierSurvey).
class ViewpointSearch {
 public:
  ViewpointSearch(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                  const ReachableSpace& reachable, const TriedViews& tried, SightMemory& memory)
      : map_(map),
        frame_(map.frame()),
        platform_(platform),
        sensor_(sensor),
        reachable_(reachable),
        tried_(tried),
        memory_(memory) {}

  [[nodiscard]] bool is_sought(const VoxelIndex& cell) const {
    const bool is_given_up = through_contested_ ? tried_.tried_enough(cell) : tried_.gave_up(cell);
    return map_.in_region(cell) && map_.at(cell) == Occupancy::Unknown && !is_given_up;
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
    std::uint32_t about = through_contested_ ? 1U << kFaceNeighbours.size() : 0;
    bool anew = through_contested_;
    for (std::size_t i = 0; i < kFaceNeighbours.size(); ++i) {
      if (is_sought(frontier + kFaceNeighbours[i])) {
        steps.push_back(kFaceNeighbours[i]);
        about |= 1U << i;
        anew = anew || tried_.tried(frontier + kFaceNeighbours[i]);
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
        frontier, about, anew, [&](const VoxelIndex& cell) { return passes(cell); },
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
  // From now on, contested cells do not end a line of sight.
  void look_through_contested() { through_contested_ = true; }
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
  bool clear(const VoxelIndex& cell) const {
    return through_contested_ ? map_.at(cell) == Occupancy::Free : memory_.is_clear(cell);
  }
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
  // As `serves`, also where a line to the centre of a face is clear, unless it looks through contested cells.
  bool sees_a_part(const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
    return open_towards(viewpoint, unknown) && in_range(viewpoint, unknown) && can_face(viewpoint, unknown) &&
           (in_sight(viewpoint, unknown, frame_.centre_of(unknown)) ||
            std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
              return !through_contested_ && faces(viewpoint, unknown, step) && clear(unknown + step) &&
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
  SightMemory& memory_;
  std::vector<VoxelIndex> places_;  // all reachable cells, listed when they are first needed
  bool through_contested_ = false;
  std::uint64_t operations_ = 0;
};

}  // namespace vantage::detail
