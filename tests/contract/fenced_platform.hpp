// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vantage/robot/grid_path.hpp>
#include <vantage/robot/wrapped_platform.hpp>
#include <vector>

#include <vantage/robot/impl/swept_sphere.hpp>

namespace vantage::testing {

/// A platform whose sensor must not enter a box of cells.
class FencedPlatform final : public WrappedPlatform {
 public:
  FencedPlatform(std::shared_ptr<const Platform> platform, const VoxelBox& fence)
      : WrappedPlatform(std::move(platform)), fence_(fence) {}

  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override {
    return wrapped().admits(map, pose) && !fence_.contains(map.frame().cell_of(pose.translation()));
  }
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override {
    return !fence_.contains(cell) && wrapped().admits_cell(map, cell);
  }
  [[nodiscard]] VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const override {
    VoxelGrid<std::uint8_t> admitted = wrapped().admitted_cells(map, box);
    for_each_cell(fence_, [&](const VoxelIndex& cell) {
      if (admitted.contains(cell)) {
        admitted[cell] = 0;
      }
    });
    return admitted;
  }
  [[nodiscard]] bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override {
    const Box fence = map.frame().box_of(fence_);
    return wrapped().admits_motion(map, from, to) &&
           detail::distance_to_segment(fence, from.translation(), to.translation()) > 0.0;
  }
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override {
    return grid_path(map, *this, from, to);
  }

 private:
  VoxelBox fence_;
};

}  // namespace vantage::testing
