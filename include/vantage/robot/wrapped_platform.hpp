// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A platform that behaves like another one, except for what a derived class overrides: a robot that exists already
/// with a further condition, or with a path search of the host's.
///
/// `admitted_cells` asks `admits_cell` of the derived class for each cell. A derived class that does not change which
/// cells are admitted should forward it, which is faster. A derived class that does should override `path`, too
/// (`grid_path(map, *this, from, to)`), because the paths of the wrapped platform do not know of it.
///
/// Its answers must depend only on the map. When a fence is lifted, the robot is another platform: make another
/// planner with it, which recalls the memory of the first (ExplorationPlanner::recall).
class WrappedPlatform : public Platform {
 public:
  /// Throws std::invalid_argument if `platform` is null.
  explicit WrappedPlatform(std::shared_ptr<const Platform> platform);

  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override {
    return platform_->admits(map, pose);
  }
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override {
    return platform_->admits_cell(map, cell);
  }
  [[nodiscard]] double reach_m() const override { return platform_->reach_m(); }
  [[nodiscard]] bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override {
    return platform_->admits_motion(map, from, to);
  }
  [[nodiscard]] Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const override {
    return platform_->facing(position_m, direction);
  }
  [[nodiscard]] double distance_m(const Pose& from, const Pose& to) const override {
    return platform_->distance_m(from, to);
  }
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override {
    return platform_->path(map, from, to);
  }
  [[nodiscard]] Box body_box(const Pose& pose) const override { return platform_->body_box(pose); }
  [[nodiscard]] bool can_tilt() const override { return platform_->can_tilt(); }

 protected:
  /// The platform that is wrapped.
  [[nodiscard]] const Platform& wrapped() const { return *platform_; }

 private:
  std::shared_ptr<const Platform> platform_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/wrapped_platform.ipp>
#endif
