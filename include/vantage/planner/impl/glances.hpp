// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vantage/geometry/pose.hpp>
#include <vector>

#include <vantage/planner/impl/tour_views.hpp>

namespace vantage::detail {

/// A path on which the sensor looks aside where there is time for it.
///
///          u                  S  sensor, at rest or on the move     V  the view at the end of the path
///          f                  u  unknown cells of parts of the frontier, f
///     S----1-------2---V      1  a glance: there the sensor looks up, at u     2  another one, it looks down
///                  |
///                  f u
///
/// A glance costs no time: there is enough to turn to it and on to the next orientation while the robot moves. A part
/// that is seen in passing need not be visited, however small it is. So each cell counts as the share that it is of
/// its part. Always the glance is added that sees most of what no other one sees.
///
/// `path`: poses joined by admitted motions. The setup must have a motion model. The path returned has the same
/// corners and ends in the same pose; its motions are admitted, too. Adds the number of visited cells to
/// `operations`.
[[nodiscard]] std::vector<Pose> with_glances(const std::vector<Pose>& path, const TourViews& parts,
                                             const Situation& situation, const Eigen::Vector3d& velocity_m_s,
                                             std::uint64_t& operations);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/glances.ipp>
#endif
