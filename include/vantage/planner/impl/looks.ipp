// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vantage/planner/looks.hpp>

#include <vantage/view/impl/look_directions.hpp>

namespace vantage {
namespace detail {

inline bool chooses_directions(const Situation& situation) {
  return LookDirections::choosable(situation.map(), situation.sensor());
}

// Whether `target` can be observed from the centre of `from`: the rule of FrontierSurvey, within the resolving range.
inline bool can_look(const Situation& situation, const FrontierTarget& target, const VoxelIndex& from,
                     std::uint64_t& operations) {
  if (from == target.viewpoint) {
    return true;
  }
  const OccupancyMap& map = situation.map();
  const RangeSensor& sensor = situation.sensor();
  const Eigen::Vector3d position = situation.reachable().position_in(from);
  const Eigen::Vector3d line = map.frame().centre_of(target.unknown) - position;
  return line.norm() <= sensor.resolving_range_m(map.resolution_m()) &&
         !situation.tried().tried_from(target.unknown, from) && !situation.tried().rests(from) &&
         sees(map, sensor, situation.platform().facing(position, line), target.unknown, operations);
}

}  // namespace detail

VANTAGE_INLINE std::optional<TargetView> look_around(const Situation& situation, double least_m3,
                                                     std::uint64_t& operations) {
  const OccupancyMap& map = situation.map();
  const Eigen::Vector3d position = situation.current().translation();
  const VoxelIndex here = map.frame().cell_of(position);
  if (std::isinf(least_m3) || !detail::chooses_directions(situation) || here != *situation.reachable().start() ||
      situation.tried().rests(here)) {
    return std::nullopt;
  }
  std::optional<detail::Look> look = detail::LookDirections(situation.surveyed(), position, operations)
                                         .best(situation.looking(), situation.setup().threads);
  const double cell_m3 = std::pow(map.resolution_m(), 3);
  return look && look->cells * cell_m3 >= least_m3 ? std::optional<TargetView>(std::move(look->seen)) : std::nullopt;
}

VANTAGE_INLINE TargetView best_look_at(const Situation& situation, const FrontierTarget& target,
                                       std::uint64_t& operations) {
  if (detail::chooses_directions(situation)) {
    const Eigen::Vector3d position = situation.reachable().position_in(target.viewpoint);
    if (std::optional<detail::Look> look =
            detail::LookDirections(situation.surveyed(), position, operations)
                .best(situation.looking(), situation.setup().threads, target.unknown)) {
      return std::move(look->seen);
    }
  }
  return view_of_target(situation.surveyed(), target, operations);
}

VANTAGE_INLINE FrontierTarget look_early(const Situation& situation, const std::vector<VoxelIndex>& way,
                                         std::uint64_t& operations) {
  constexpr double kLookSpacingM = 0.5;
  const FrontierSurvey& survey = situation.survey();
  const VoxelFrame& frame = situation.map().frame();
  const auto looked_at_from = [](FrontierTarget target, const VoxelIndex& cell) {
    target.viewpoint = cell;
    return target;
  };
  const FrontierTarget wanted = *survey.target_seen_from(way.back());
  double gone_m = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    gone_m += i == 0 ? 0.0 : (frame.centre_of(way[i]) - frame.centre_of(way[i - 1])).norm();
    const auto in_sight = [&](const FrontierTarget& target) {
      return detail::can_look(situation, target, way[i], operations);
    };
    if (in_sight(wanted)) {
      return looked_at_from(wanted, way[i]);
    }
    if (gone_m >= kLookSpacingM) {
      const auto other = std::find_if(survey.targets.begin(), survey.targets.end(), in_sight);
      if (other != survey.targets.end()) {
        return looked_at_from(*other, way[i]);
      }
    }
  }
  return wanted;
}

}  // namespace vantage
