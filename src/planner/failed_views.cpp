// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>
#include <vantage/planner/failed_views.hpp>

#include "map/option_rule.hpp"

namespace vantage {
namespace {

int known_neighbours(const OccupancyMap& map, const VoxelIndex& cell) {
  return static_cast<int>(std::count_if(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
    return map.at(cell + step) != Occupancy::Unknown;
  }));
}

// As near as a robot comes to its goals: within a cell of the position, and ten degrees of the direction.
bool arrived(const OccupancyMap& map, const Pose& goal, const Pose& current) {
  constexpr double kCosine = 0.985;
  return (goal.translation() - current.translation()).norm() <= map.resolution_m() &&
         optical_axis(goal).dot(optical_axis(current)) >= kCosine;
}

}  // namespace

FailedViews::FailedViews(int patience) : patience_(patience) {
  detail::require_option(patience > 0, "FailedViews::patience", patience, "> 0");
}

void FailedViews::expect(const OccupancyMap& map, const Pose& goal, std::vector<VoxelIndex> sought,
                         std::vector<VoxelIndex> hoped) {
  expected_ = Expectation{goal, map.revision(), std::move(sought), std::move(hoped)};
}

void FailedViews::fail(const OccupancyMap& map, const VoxelIndex& viewpoint, const std::vector<VoxelIndex>& cells) {
  for (const VoxelIndex& cell : cells) {
    if (map.at(cell) == Occupancy::Unknown) {
      Failures& failures = failures_[cell];
      may_have_failed_.insert(cell);
      if (!failed_from(cell, viewpoint)) {
        failures.viewpoints.push_back(viewpoint);
      }
      failures.known_neighbours = known_neighbours(map, cell);
    }
  }
}

void FailedViews::review(const OccupancyMap& map, const Pose& current) {
  if (map_.is(map) && reviewed_ == map.revision()) {
    return;
  }
  map_ = KnownMap(map);
  reviewed_ = map.revision();
  // By neighbours that are known, not by those that change their mind: surfaces flip between free and occupied for
  // ever, while what is known only grows, so no cell gets more than six chances
  // (unless the host makes the map forget).
  std::erase_if(failures_, [&](const auto& entry) {
    const auto& [cell, failures] = entry;
    return map.at(cell) != Occupancy::Unknown || known_neighbours(map, cell) > failures.known_neighbours;
  });
  may_have_failed_.clear();
  for (const auto& entry : failures_) {
    may_have_failed_.insert(entry.first);
  }
  if (!expected_ || expected_->revision >= map.revision() || !arrived(map, expected_->goal, current)) {
    return;
  }
  const VoxelIndex viewpoint = map.frame().cell_of(expected_->goal.translation());
  const std::vector<VoxelIndex>& sought = expected_->sought;
  if (std::any_of(sought.begin(), sought.end(),
                  [&](const VoxelIndex& cell) { return map.at(cell) == Occupancy::Unknown; })) {
    views_[map.frame().cell_of(current.translation())].push_back(current);
  }
  fail(map, viewpoint, sought);
  const std::vector<VoxelIndex>& hoped = expected_->hoped;
  if (std::all_of(hoped.begin(), hoped.end(),
                  [&](const VoxelIndex& cell) { return map.at(cell) == Occupancy::Unknown; })) {
    fail(map, viewpoint, hoped);
  }
  expected_.reset();
}

const FailedViews::Failures* FailedViews::failures_of(const VoxelIndex& unknown) const {
  if (!may_have_failed_.contains(unknown)) {
    return nullptr;
  }
  const auto failure = failures_.find(unknown);
  return failure == failures_.end() ? nullptr : &failure->second;
}

bool FailedViews::failed_from(const VoxelIndex& unknown, const VoxelIndex& viewpoint) const {
  const Failures* failures = failures_of(unknown);
  return failures != nullptr &&
         std::find(failures->viewpoints.begin(), failures->viewpoints.end(), viewpoint) != failures->viewpoints.end();
}

std::span<const Pose> FailedViews::views_from(const VoxelIndex& viewpoint) const {
  const auto views = views_.find(viewpoint);
  return views == views_.end() ? std::span<const Pose>() : std::span<const Pose>(views->second);
}

bool FailedViews::failed_towards(const VoxelIndex& unknown, const VoxelIndex& viewpoint, double within_rad) const {
  const Failures* failures = failures_of(unknown);
  if (failures == nullptr) {
    return false;
  }
  const auto direction_to = [&](const VoxelIndex& place) {
    const VoxelIndex step = place - unknown;
    return Eigen::Vector3d(step.x, step.y, step.z).normalized().eval();
  };
  const Eigen::Vector3d towards = direction_to(viewpoint);
  const double least_cosine = std::cos(within_rad);
  const auto& viewpoints = failures->viewpoints;
  return std::any_of(viewpoints.begin(), viewpoints.end(), [&](const VoxelIndex& place) {
    return place == viewpoint || direction_to(place).dot(towards) >= least_cosine;
  });
}

bool FailedViews::gave_up(const VoxelIndex& unknown) const {
  const Failures* failures = failures_of(unknown);
  return failures != nullptr && failures->viewpoints.size() >= static_cast<std::size_t>(patience_);
}

}  // namespace vantage
