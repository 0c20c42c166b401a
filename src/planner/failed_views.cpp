// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vantage/planner/failed_views.hpp>

namespace vantage {
namespace {

int known_neighbours(const OccupancyMap& map, const VoxelIndex& cell) {
  return static_cast<int>(std::count_if(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
    return map.at(cell + step) != Occupancy::Unknown;
  }));
}

}  // namespace

void FailedViews::expect(const OccupancyMap& map, const Pose& goal, std::vector<VoxelIndex> sought) {
  expected_ = Expectation{goal, map.revision(), std::move(sought)};
}

void FailedViews::review(const OccupancyMap& map, const Pose& current) {
  if (reviewed_ == map.revision()) {
    return;
  }
  reviewed_ = map.revision();
  // By neighbours that are known, not by those that change their mind: surfaces flip between free and occupied for
  // ever, while what is known only grows, so no cell gets more than six chances.
  std::erase_if(failures_, [&](const auto& entry) {
    const auto& [cell, failures] = entry;
    return map.at(cell) != Occupancy::Unknown || known_neighbours(map, cell) > failures.known_neighbours;
  });
  if (!expected_ || expected_->revision >= map.revision() || !expected_->goal.isApprox(current, 1e-6)) {
    return;
  }
  const VoxelIndex viewpoint = map.frame().cell_of(current.translation());
  for (const VoxelIndex& cell : expected_->sought) {
    if (map.at(cell) == Occupancy::Unknown) {
      Failures& failures = failures_[cell];
      if (!failed_from(cell, viewpoint)) {
        failures.viewpoints.push_back(viewpoint);
      }
      failures.known_neighbours = known_neighbours(map, cell);
    }
  }
  expected_.reset();
}

bool FailedViews::failed_from(const VoxelIndex& unknown, const VoxelIndex& viewpoint) const {
  const auto failure = failures_.find(unknown);
  return failure != failures_.end() && std::find(failure->second.viewpoints.begin(), failure->second.viewpoints.end(),
                                                 viewpoint) != failure->second.viewpoints.end();
}

bool FailedViews::gave_up(const VoxelIndex& unknown) const {
  const auto failure = failures_.find(unknown);
  return failure != failures_.end() && failure->second.viewpoints.size() >= static_cast<std::size_t>(patience_);
}

}  // namespace vantage
