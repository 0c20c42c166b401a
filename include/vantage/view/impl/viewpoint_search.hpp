// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
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

#include <vantage/view/impl/can_face.hpp>
#include <vantage/view/impl/sight_memory.hpp>
#include <vantage/view/impl/visited_cells.hpp>

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
    return map_.in_region(cell) && map_.at(cell) == Occupancy::Unknown &&
           (closely_ ? tried_.tried(cell) && !tried_.looked_closely(map_, cell) : !tried_.gave_up(cell));
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
  // From now on only those cells are sought that were looked at, but not closely, along clear lines.
  void look_closely() { closely_ = true; }
  // `try_all`, `try_parts` and `try_past` test every reachable cell, until `operations` more are used up.
  void limit_to(std::uint64_t operations) { most_operations_ = operations_ + operations; }
  [[nodiscard]] bool used_up() const { return operations_ >= most_operations_; }
  std::optional<VoxelIndex> try_all(const VoxelIndex& unknown) {
    return place_of_all(unknown, [&](const VoxelIndex& cell) { return serves(cell, unknown); });
  }
  std::optional<VoxelIndex> try_parts(const VoxelIndex& unknown) {
    return place_of_all(unknown, [&](const VoxelIndex& cell) { return sees_a_part(cell, unknown); });
  }
  // A target for lines that pass other unknown cells beside `unknown`: even if a line only cuts a corner of the first
  // one, that becomes known.
  std::optional<FrontierTarget> try_past(const VoxelIndex& unknown) {
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
    const auto place = first_place(
        unknown,
        [&](const VoxelIndex& cell) {
          return map_.at(cell) == Occupancy::Free || (beside.contains(cell) && is_sought(cell));
        },
        [&](const VoxelIndex& cell) {
          return open_towards(cell, unknown) &&
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
                       [&](const VoxelIndex& step) { return is_free(unknown + step); });
  }
  template <class Serves>
  std::optional<VoxelIndex> place_of_all(const VoxelIndex& unknown, Serves&& serves) {
    return can_be_seen(unknown)
               ? first_place(
                     unknown, [&](const VoxelIndex& cell) { return map_.at(cell) == Occupancy::Free; }, serves)
               : std::nullopt;
  }
  // A reachable cell in range that serves; none if no cell serves, or if the operations are used up. A line of sight
  // never turns back along an axis. So only those cells are tested to which steps lead that are all away from
  // `unknown`, eight times: for each combination of directions along the axes.
  //
  //     # # # 6 7     1 to 7 are tested, up and to the right
  //     # 3 4 5 #     #  blocks
  //     1 2 # # .     .  not tested: each path there turns back
  //     u # . . .
  template <class Passes, class Serves>
  std::optional<VoxelIndex> first_place(const VoxelIndex& unknown, Passes&& passes_through, Serves&& serves) {
    Box towards_places = box_of_places();
    extend(towards_places, VoxelBox{unknown, unknown + VoxelIndex{1, 1, 1}});
    for (unsigned int octant = 0; octant < 8; ++octant) {
      const std::array<VoxelIndex, 3> away{VoxelIndex{(octant & 1U) != 0 ? 1 : -1, 0, 0},
                                           VoxelIndex{0, (octant & 2U) != 0 ? 1 : -1, 0},
                                           VoxelIndex{0, 0, (octant & 4U) != 0 ? 1 : -1}};
      VisitedCells visited;
      met_.assign(1, unknown);
      for (std::size_t next = 0; next < met_.size(); ++next) {
        for (const VoxelIndex& step : away) {
          const VoxelIndex cell = met_[next] + step;
          if (used_up()) {
            return std::nullopt;
          }
          ++operations_;
          if (!visited.insert(cell) || !towards_places.contains(frame_.centre_of(cell)) ||
              !near_enough(cell, unknown) || !passes_through(cell)) {
            continue;
          }
          met_.push_back(cell);
          if (memory_.is_reachable(cell) && in_range(cell, unknown) && serves(cell)) {
            return cell;
          }
        }
      }
    }
    return std::nullopt;
  }
  // Contains all reachable cells.
  const Box& box_of_places() {
    if (!box_of_places_) {
      box_of_places_ = Box{};
      reachable_.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& /*cells*/) {
        extend(*box_of_places_, Brick::cells_of(brick));
      });
    }
    return *box_of_places_;
  }
  void extend(Box& box, const VoxelBox& cells) const {
    const Box more = frame_.box_of(cells);
    box.extend(more.min);
    box.extend(more.max);
  }
  bool is_free(const VoxelIndex& cell) const { return memory_.is_free(cell); }
  bool passes(const VoxelIndex& cell) {
    ++operations_;
    return is_free(cell);
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

  // Cheap tests first. Most lines fail beside the unknown cell, or leave the field of view of a level camera.
  bool serves(const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
    return open_towards(viewpoint, unknown) && in_range(viewpoint, unknown) && can_face(viewpoint, unknown) &&
           in_sight(viewpoint, unknown, frame_.centre_of(unknown));
  }
  // As `serves`, also where a line to the centre of a face is clear.
  bool sees_a_part(const VoxelIndex& viewpoint, const VoxelIndex& unknown) {
    return open_towards(viewpoint, unknown) && in_range(viewpoint, unknown) && can_face(viewpoint, unknown) &&
           (in_sight(viewpoint, unknown, frame_.centre_of(unknown)) ||
            std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
              return faces(viewpoint, unknown, step) && is_free(unknown + step) &&
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
    const VoxelRay line(frame_, frame_.centre_of(viewpoint), point);
    const auto is_open = [&](const VoxelIndex& cell) { return passes(cell) || cell == unknown; };
    return line.all_from_the_end(is_open) && (!closely_ || line.all_touched(is_open));
  }
  // Whether a line of sight from `viewpoint` can enter `unknown` through a free neighbour on its side.
  bool open_towards(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    const VoxelIndex away = viewpoint - unknown;
    return (away.x != 0 && is_free(unknown + VoxelIndex{away.x > 0 ? 1 : -1, 0, 0})) ||
           (away.y != 0 && is_free(unknown + VoxelIndex{0, away.y > 0 ? 1 : -1, 0})) ||
           (away.z != 0 && is_free(unknown + VoxelIndex{0, 0, away.z > 0 ? 1 : -1}));
  }
  [[nodiscard]] double range_m(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    return (frame_.centre_of(unknown) - frame_.centre_of(viewpoint)).norm();
  }
  [[nodiscard]] bool near_enough(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    return range_m(viewpoint, unknown) <= sensor_.max_range_m;
  }
  [[nodiscard]] bool in_range(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    return range_m(viewpoint, unknown) >= sensor_.min_range_m && near_enough(viewpoint, unknown);
  }
  bool can_face(const VoxelIndex& viewpoint, const VoxelIndex& unknown) const {
    const Eigen::Vector3d from = frame_.centre_of(viewpoint);
    return !(closely_ ? tried_.looked_from_beside(map_, unknown, viewpoint)
                      : tried_.tried_from(unknown, viewpoint)) &&
           detail::can_face(platform_, sensor_, from, frame_.centre_of(unknown) - from);
  }

  const OccupancyMap& map_;
  VoxelFrame frame_;
  const Platform& platform_;
  const RangeSensor& sensor_;
  const ReachableSpace& reachable_;
  const TriedViews& tried_;
  SightMemory& memory_;
  std::optional<Box> box_of_places_;
  std::vector<VoxelIndex> met_;  // by one search, in order
  bool closely_ = false;
  std::uint64_t operations_ = 0;
  std::uint64_t most_operations_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace vantage::detail
