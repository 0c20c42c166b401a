// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// References to a map, the robot and the results of a survey. All must outlive this struct.
struct SurveyedMap {
  const OccupancyMap& map;          ///< the surveyed map
  const RangeSensor& sensor;        ///< the sensor that is to see the targets
  const Platform& platform;         ///< the body that carries the sensor
  const ReachableSpace& reachable;  ///< the cells to which the body can bring the sensor
  const FrontierSurvey& survey;     ///< the result of the survey, with the targets
  const TriedViews& tried;          ///< memory of the views that were tried
};

/// A view and the cells that it is to resolve.
struct TargetView {
  View view;                             ///< its utility is the number of targets seen, unless a planner replaces it
  std::vector<VoxelIndex> unknown = {};  ///< the unknown cells of these targets, in the order of the survey
  /// More unknown cells that it may resolve. They count as looked at in vain only if it resolves none of them.
  std::vector<VoxelIndex> hoped = {};
};

/// The targets of the survey that the sensor sees from `pose` (world_from_sensor), within its range and within the
/// range in which it resolves cells of the map (RangeSensor::resolving_range_m); none if the place rests
/// (TriedViews). Adds the number of visited cells to `operations`.
[[nodiscard]] TargetView targets_seen_from(const SurveyedMap& surveyed, const Pose& pose, std::uint64_t& operations);

/// A view from the viewpoint of `wanted` that sees `wanted` and, among the orientations tried, the largest number of
/// other targets within the resolving range. If the body has no room for it, one of the 26 orientations towards
/// neighbouring cells for which it has, if there is one. Adds the number of visited cells to `operations`.
[[nodiscard]] TargetView view_of_target(const SurveyedMap& surveyed, const FrontierTarget& wanted,
                                        std::uint64_t& operations);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/target_view.ipp>
#endif
