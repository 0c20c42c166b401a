// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vantage/view/sensing_constraint.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {

VANTAGE_INLINE void validate(const SensingOptions& options) {
  detail::require_option(options.max_incidence_rad > 0.0 && options.max_incidence_rad <= std::numbers::pi / 2,
                         "SensingOptions::max_incidence_rad", options.max_incidence_rad, "in (0, pi / 2]");
  detail::require_option(std::isfinite(options.min_depth_m) && options.min_depth_m >= 0.0,
                         "SensingOptions::min_depth_m", options.min_depth_m, ">= 0");
  detail::require_option(options.max_depth_m > options.min_depth_m, "SensingOptions::max_depth_m",
                         options.max_depth_m, "> min_depth_m");
}

VANTAGE_INLINE Eigen::Vector3f surface_normal(const OccupancyMap& map, const VoxelIndex& cell) {
  Eigen::Vector3f outwards = Eigen::Vector3f::Zero();
  for_each_cell({{-2, -2, -2}, {3, 3, 3}}, [&](const VoxelIndex& step) {
    if (map.at(cell + step) == Occupancy::Free) {
      const Eigen::Vector3f offset = Eigen::Vector3i(step.x, step.y, step.z).cast<float>();
      outwards += offset / std::max(offset.squaredNorm(), 1.0F);
    }
  });
  constexpr float kNoSide = 1e-3F;
  const float length = outwards.norm();
  return length < kNoSide ? Eigen::Vector3f::Zero() : Eigen::Vector3f(outwards / length);
}

VANTAGE_INLINE SensingConstraint measurable(const OccupancyMap& map, const VoxelBox& object,
                                            const SensingOptions& options) {
  validate(options);
  std::shared_ptr<VoxelGrid<Eigen::Vector3f>> normals;
  if (options.max_incidence_rad < std::numbers::pi / 2) {
    normals = std::make_shared<VoxelGrid<Eigen::Vector3f>>(object, Eigen::Vector3f::Zero());
    for_each_cell(object, [&](const VoxelIndex& cell) {
      // A ray enters a cell through a face, so one face neighbour must be free.
      const bool can_be_seen = map.at(cell) != Occupancy::Free &&
                               std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                                           [&](const auto& step) { return map.at(cell + step) == Occupancy::Free; });
      if (can_be_seen) {
        (*normals)[cell] = surface_normal(map, cell);
      }
    });
  }
  return [normals, options, frame = map.frame()](const Pose& pose, CellSet& seen) {
    const double cosine = std::cos(options.max_incidence_rad);
    const auto measures = [&](const VoxelIndex& cell) {
      const Eigen::Vector3d back = pose.translation() - frame.centre_of(cell);
      const double depth_m = back.norm();
      if (depth_m < options.min_depth_m || depth_m > options.max_depth_m) {
        return false;
      }
      const Eigen::Vector3f normal =
          normals ? normals->value_or(cell, Eigen::Vector3f::Zero()) : Eigen::Vector3f::Zero();
      return normal.isZero() || normal.cast<double>().dot(back) >= cosine * depth_m;
    };
    const CellSet all = seen;
    all.for_each([&](const VoxelIndex& cell) {
      if (!measures(cell)) {
        seen.erase(cell);
      }
    });
  };
}

}  // namespace vantage
