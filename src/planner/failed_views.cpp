// SPDX-License-Identifier: MIT
#include <unordered_set>
#include <utility>
#include <vantage/planner/failed_views.hpp>

namespace vantage {

void FailedViews::expect(const OccupancyMap& map, const Pose& pose, std::vector<VoxelIndex> unknown_cells) {
  expected_ = Expectation{pose, map.revision(), std::move(unknown_cells)};
}

void FailedViews::review(const OccupancyMap& map, const Pose& current) {
  if (reviewed_ == map.revision()) {
    return;
  }
  if (reviewed_ && *reviewed_ < map.revision() && !failures_.empty()) {
    const std::vector<VoxelIndex> bricks = map.changed_since(*reviewed_);
    const std::unordered_set<VoxelIndex> changed(bricks.begin(), bricks.end());
    std::erase_if(failures_, [&](const auto& entry) { return changed.contains(Brick::of_cell(entry.first)); });
  }
  reviewed_ = map.revision();
  if (!expected_ || expected_->revision >= map.revision()) {
    return;
  }
  if (expected_->pose.isApprox(current, 1e-6)) {
    for (const VoxelIndex& cell : expected_->cells) {
      if (map.at(cell) == Occupancy::Unknown) {
        ++failures_[cell];
      }
    }
    expected_.reset();
  }
}

bool FailedViews::gave_up(const VoxelIndex& unknown) const {
  const auto failure = failures_.find(unknown);
  return failure != failures_.end() && failure->second >= patience_;
}

}  // namespace vantage
