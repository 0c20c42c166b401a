// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <vantage/view/aimed_views.hpp>

#include <vantage/geometry/impl/dice.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline std::vector<CellSide> visible_faces(const RayCaster& caster, const CellSet& sought) {
  std::vector<CellSide> faces;
  sought.for_each([&](const VoxelIndex& cell) {
    if (caster.at(cell) != Occupancy::Unknown) {
      return;
    }
    for (const VoxelIndex& step : kFaceNeighbours) {
      if (caster.at(cell + step) == Occupancy::Free) {
        faces.push_back({cell, step});
      }
    }
  });
  return faces;
}

inline std::optional<Pose> view_of(const CellSide& side, const RayCaster& caster, const AimedViewOptions& options,
                                   Dice& dice) {
  constexpr int kDraws = 64;
  constexpr double kIntoFreeCell = 0.5 + 1e-3;  // in cells, from the centre of the cell: just beyond the cell
  const Eigen::Vector3d step(side.normal.x, side.normal.y, side.normal.z);
  const Eigen::Vector3d normal = step.normalized();
  const Eigen::Vector3d on_side = caster.frame().centre_of(side.cell) + kIntoFreeCell * caster.frame().size_m * step;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::Vector3d towards = normal + dice.direction();
    const double distance_m =
        options.min_distance_m + dice.share() * (options.max_distance_m - options.min_distance_m);
    if (towards.norm() < 1e-3) {
      continue;
    }
    const Eigen::Vector3d place = on_side + distance_m * towards.normalized();
    if (caster.cast(on_side, place).occupancy == Occupancy::Free) {
      return pose_looking_along(place, on_side - place);
    }
  }
  return std::nullopt;
}

}  // namespace detail

VANTAGE_INLINE void validate(const AimedViewOptions& options) {
  detail::require_option(std::isfinite(options.min_distance_m) && options.min_distance_m > 0.0,
                         "AimedViewOptions::min_distance_m", options.min_distance_m, "> 0");
  detail::require_option(std::isfinite(options.max_distance_m) && options.max_distance_m >= options.min_distance_m,
                         "AimedViewOptions::max_distance_m", options.max_distance_m, ">= min_distance_m");
}

VANTAGE_INLINE std::vector<Pose> aimed_views(const RayCaster& caster, const CellSet& sought,
                                             const AimedViewOptions& options, std::uint64_t seed) {
  validate(options);
  return options.count == 0 ? std::vector<Pose>()
                            : aimed_views(caster, detail::visible_faces(caster, sought), options, seed);
}

VANTAGE_INLINE std::vector<Pose> aimed_views(const RayCaster& caster, std::span<const CellSide> sides,
                                             const AimedViewOptions& options, std::uint64_t seed) {
  validate(options);
  std::vector<Pose> views;
  detail::Dice dice(seed);
  for (std::size_t i = 0; i < options.count && !sides.empty(); ++i) {
    if (const std::optional<Pose> view = detail::view_of(sides[dice.below(sides.size())], caster, options, dice)) {
      views.push_back(*view);
    }
  }
  return views;
}

}  // namespace vantage
