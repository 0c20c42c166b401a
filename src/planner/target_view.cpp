// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vantage/planner/situation.hpp>
#include <vantage/planner/target_view.hpp>

namespace vantage {
namespace {

struct Sighting {
  VoxelIndex unknown;
  Eigen::Vector3d line;  // from the viewpoint to the centre of the cell, metres, world
};

// Cells beyond the resolving range may lie between the rays, so a view does not count them.
double counted_range_m(const OccupancyMap& map, const RangeSensor& sensor) {
  return std::min(sensor.max_range_m, sensor.resolving_range_m(map.resolution_m()));
}

// The targets in clear line of sight within `furthest_m`, whatever the orientation. Those whose viewpoint this is are
// in sight, if only in part.
std::vector<Sighting> sightings_from(const OccupancyMap& map, const RangeSensor& sensor, const FrontierSurvey& survey,
                                     const Eigen::Vector3d& position, double furthest_m, std::uint64_t& operations) {
  std::vector<Sighting> sightings;
  const VoxelIndex place = map.frame().cell_of(position);
  for (const FrontierTarget& target : survey.targets) {
    const Eigen::Vector3d line = map.frame().centre_of(target.unknown) - position;
    const double range_m = line.norm();
    if (range_m >= sensor.min_range_m && range_m <= furthest_m &&
        (target.viewpoint == place || in_plain_sight(map, position, target.unknown, operations))) {
      sightings.push_back({target.unknown, line});
    }
  }
  return sightings;
}

TargetView keep_in_view(const RangeSensor& sensor, const Pose& pose, const std::vector<Sighting>& sightings) {
  TargetView seen{.view = {.pose = pose}};
  for (const Sighting& sighting : sightings) {
    if (sensor.in_view(pose.linear().transpose() * sighting.line)) {
      seen.unknown.push_back(sighting.unknown);
    }
  }
  seen.view.utility = static_cast<double>(seen.unknown.size());
  return seen;
}

}  // namespace

TargetView targets_seen_from(const Situation& situation, const Pose& pose, std::uint64_t& operations) {
  const OccupancyMap& map = situation.map();
  const RangeSensor& sensor = situation.sensor();
  const double furthest_m = counted_range_m(map, sensor);
  const VoxelIndex place = map.frame().cell_of(pose.translation());
  TargetView seen{.view = {.pose = pose}};
  if (situation.tried().rests(place)) {
    return seen;
  }
  for (const FrontierTarget& target : situation.survey().targets) {
    const Eigen::Vector3d line = map.frame().centre_of(target.unknown) - pose.translation();
    const bool in_sight = target.viewpoint == place
                              ? sensor.in_view(pose.linear().transpose() * line)
                              : line.norm() <= furthest_m && sees(map, sensor, pose, target.unknown, operations);
    if (in_sight) {
      seen.unknown.push_back(target.unknown);
    }
  }
  seen.view.utility = static_cast<double>(seen.unknown.size());
  return seen;
}

TargetView view_of_target(const Situation& situation, const FrontierTarget& wanted, std::uint64_t& operations) {
  const OccupancyMap& map = situation.map();
  const RangeSensor& sensor = situation.sensor();
  const Platform& platform = situation.platform();
  const Eigen::Vector3d position = situation.reachable().position_in(wanted.viewpoint);
  const Eigen::Vector3d line = map.frame().centre_of(wanted.unknown) - position;
  const double furthest_m = std::max(counted_range_m(map, sensor), line.norm());
  const std::vector<Sighting> sightings =
      sightings_from(map, sensor, situation.survey(), position, furthest_m, operations);
  TargetView best = keep_in_view(sensor, platform.facing(position, line), sightings);
  // Orientations half-way between the wanted target and about 32 others, evenly chosen from the list: more of them
  // come into view together with the wanted one.
  constexpr std::size_t kTried = 32;
  const std::size_t stride = sightings.size() / kTried + 1;
  for (std::size_t i = 0; i < sightings.size(); i += stride) {
    const Eigen::Vector3d between = line.normalized() + sightings[i].line.normalized();
    if (between.norm() < 1e-3) {
      continue;
    }
    const Pose pose = platform.facing(position, between);
    if (!sensor.in_view(pose.linear().transpose() * line)) {
      continue;
    }
    TargetView candidate = keep_in_view(sensor, pose, sightings);
    if (candidate.view.utility > best.view.utility) {
      best = std::move(candidate);
    }
  }
  return best;
}

}  // namespace vantage
