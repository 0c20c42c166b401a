// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/planner/situation.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/target_view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

// Steps that any strategy of a FrontierPlanner may use, in `choose`: there is a target, and the reachable space has a
// start. All add the number of cells that rays visit to `operations`.

/// A view from the current place that is expected to make most unknown cells known, among the orientations that see
/// a target. None if it would show less than `least_m3` (infinity: always none), if no orientation sees a target,
/// if the orientation does not matter (the sensor sees all around, or the map is one layer of cells), if the place
/// rests (TriedViews), or if the robot is not in the start cell of the reachable space.
[[nodiscard]] std::optional<TargetView> look_around(const Situation& situation, double least_m3,
                                                    std::uint64_t& operations);

/// A view of the target from its viewpoint, in the orientation that is expected to make most unknown cells known. If
/// the orientation does not matter, the sensor faces the unknown cell.
[[nodiscard]] TargetView best_look_at(const Situation& situation, const FrontierTarget& target,
                                      std::uint64_t& operations);

/// The target that is seen first along `way`, with that cell of the way as its viewpoint: either the target at the
/// end of the way or, after half a metre, any other one. `way` must be reachable cells, of which the last
/// is the viewpoint of a target.
[[nodiscard]] FrontierTarget look_early(const Situation& situation, const std::vector<VoxelIndex>& way,
                                        std::uint64_t& operations);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/looks.ipp>
#endif
