// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/robot/way_around.hpp>

namespace vantage {

VANTAGE_INLINE std::optional<std::vector<Pose>> way_around(const OccupancyMap& map, const Platform& platform,
                                                           const Pose& from, const Pose& to,
                                                           const Eigen::Vector3d& middle) {
  if (platform.admits_motion(map, from, to)) {
    return std::vector<Pose>{from, to};
  }
  const Eigen::Vector3d first = from.translation() - middle;
  const Eigen::Vector3d last = to.translation() - middle;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(first, last);
  constexpr int kSteps = 24;
  std::vector<Pose> arc{from};
  for (int i = 1; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const double radius_m = first.norm() + share * (last.norm() - first.norm());
    const Eigen::Vector3d outwards =
        Eigen::Quaterniond::Identity().slerp(share, turn) * Eigen::Vector3d(first.normalized());
    const Pose next = i == kSteps ? to : platform.facing(middle + radius_m * outwards, -outwards);
    if (!platform.admits(map, next) || !platform.admits_motion(map, arc.back(), next)) {
      return platform.path(map, from, to);
    }
    arc.push_back(next);
  }
  return arc;
}

}  // namespace vantage
