// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/view/impl/look_directions.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/geometry/impl/spread_directions.hpp>
#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/view/impl/ranked_views.hpp>

namespace vantage::detail {

// About 20 degrees between neighbours, less than half of a camera's field of view.
inline constexpr std::size_t kDirections = 128;
inline constexpr std::size_t kFinalists = 5;  // directions that are compared with all rays
// Mean free path of sight in unknown space, metres.
inline constexpr double kSightM = 4.0;
// Probability that the surface continues in an unknown cell beside it.
inline constexpr double kOpaqueBesideSurface = 0.5;

// The unknown cells in a box with half-side `range_m` around the position.
inline BrickSet unknown_cells_around(const OccupancyMap& map, const Eigen::Vector3d& position, double range_m) {
  const Eigen::Vector3d range = Eigen::Vector3d::Constant(range_m);
  const VoxelBox near{map.frame().cell_of(position - range),
                      map.frame().cell_of(position + range) + VoxelIndex{1, 1, 1}};
  const VoxelBox box = box_overlap(near, map.bounds());
  const VoxelIndex one{1, 1, 1};
  BrickSet cells;
  for_each_cell({Brick::of_cell(box.lo), Brick::of_cell(box.hi - one) + one}, [&](const VoxelIndex& brick) {
    BrickPlane unknown = plane_of(brick, box);
    if (const Brick* const known = map.find_brick(brick)) {
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        unknown[word] &= ~known->known[word];
      }
    }
    (void)cells.assign(brick, unknown);
  });
  return cells;
}

VANTAGE_INLINE LookDirections::LookDirections(const SurveyedMap& surveyed, const Eigen::Vector3d& position,
                                              std::uint64_t& operations)
    : surveyed_(surveyed),
      position_(position),
      place_(surveyed.map.frame().cell_of(position)),
      targets_(surveyed, surveyed.survey.targets, position, counted_range_m(surveyed.map, surveyed.sensor),
               operations),
      operations_(operations) {
  const OccupancyMap& map = surveyed.map;
  const RangeSensor& sensor = surveyed.sensor;
  targets_.leave_out_tried();
  if (!targets_.all().empty()) {
    sight_.emplace(map, unknown_cells_around(map, position, sensor.max_range_m),
                   UnknownSightOptions{.opaque_share = 1.0 - std::exp(-map.resolution_m() / kSightM),
                                       .opaque_beside_surface = kOpaqueBesideSurface,
                                       .reports_no_return = sensor.reports_no_return});
  }
}

// A sensor that looks all around horizontally sees nearly the same in every direction.
VANTAGE_INLINE bool LookDirections::choosable(const OccupancyMap& map, const RangeSensor& sensor) {
  return !sensor.looks_all_around() && map.bounds().hi.z - map.bounds().lo.z > 1;
}

VANTAGE_INLINE std::optional<Look> LookDirections::best(const FollowingCaster& looking, int threads,
                                                        const std::optional<VoxelIndex>& wanted) const {
  std::vector<Look> looks;
  for (const Eigen::Vector3d& direction : spread_directions(kDirections)) {
    const Pose pose = surveyed_.platform.facing(position_, direction);
    TargetView seen = targets_.in_view(pose);
    const bool serves = wanted ? std::find(seen.unknown.begin(), seen.unknown.end(), *wanted) != seen.unknown.end()
                               : !seen.unknown.empty();
    if (serves) {
      looks.push_back({std::move(seen)});
    }
  }
  if (looks.empty()) {
    return std::nullopt;
  }
  rank_views(
      looking, threads, looks, kFinalists, kFinalists, operations_,
      [&](Look& look, const ViewRays& rays) { count_expected_cells(look, looking.caster(), rays); },
      [](const Look& a, const Look& b) {
        return a.cells != b.cells ? a.cells > b.cells : a.seen.unknown.size() > b.seen.unknown.size();
      });
  return std::move(looks.front());
}

VANTAGE_INLINE void LookDirections::count_expected_cells(Look& look, const RayCaster& caster,
                                                         const ViewRays& rays) const {
  look.cells = 0.0;
  for (const SightedCell& seen : sight_->look(caster, look.seen.view.pose, rays, look.operations)) {
    if (!surveyed_.tried.tried_from(seen.cell, place_) && !surveyed_.tried.gave_up(seen.cell) &&
        !was_in_view(seen.cell)) {
      look.cells += seen.chance;
    }
  }
}

// Whether the cell was in the field of view of a scan from this place, which did not resolve it.
VANTAGE_INLINE bool LookDirections::was_in_view(const VoxelIndex& cell) const {
  const VoxelFrame& frame = surveyed_.map.frame();
  const Eigen::Vector3d line = frame.centre_of(cell) - position_;
  const auto& scans = surveyed_.tried.scanned_from();
  return std::any_of(scans.begin(), scans.end(), [&](const Pose& pose) {
    return frame.cell_of(pose.translation()) == place_ && surveyed_.sensor.in_view(pose.linear().transpose() * line);
  });
}

}  // namespace vantage::detail
