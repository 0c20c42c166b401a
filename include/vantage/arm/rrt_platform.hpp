// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// How an RrtPlatform searches.
struct RrtOptions {
  double goal_bias = 0.05;          ///< share of the draws that are the goal itself, in [0, 1)
  double step_m = 0.3;              ///< a branch grows by at most so much, > 0
  std::size_t iterations = 20'000;  ///< draws before a path is given up, > 0
  std::uint64_t seed = 1;           ///< of the draws
};

/// A platform whose paths are found by a goal-biased rapidly exploring random tree (LaValle & Kuffner 2001) in the
/// space of the sensor's positions, as the robot of Vasquez-Gomez et al. 2013 finds its own, through OMPL; in all
/// else it is the platform that it is made from. Where the way there is wide, a tree finds some way sooner than a
/// search over all cells finds the shortest; where it is narrow, it may find none.
///
///     const auto robot = std::make_shared<RrtPlatform>(std::make_shared<FreeFlyer>(body));
class RrtPlatform final : public Platform {
 public:
  /// Throws std::invalid_argument naming the option at fault, or if there is no platform.
  explicit RrtPlatform(std::shared_ptr<const Platform> platform, const RrtOptions& options = {});

  /// The options it was made with.
  [[nodiscard]] const RrtOptions& options() const { return options_; }

  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override {
    return platform_->admits(map, pose);
  }
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override {
    return platform_->admits_cell(map, cell);
  }
  [[nodiscard]] VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const override {
    return platform_->admitted_cells(map, box);
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
  /// Straight if the platform admits that; else what the tree finds, less every corner that a straight admitted
  /// motion makes needless. Between the ends the sensor looks along its way. The same input gives the same path.
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override;
  [[nodiscard]] Box body_box(const Pose& pose) const override { return platform_->body_box(pose); }
  [[nodiscard]] bool can_tilt() const override { return platform_->can_tilt(); }

 private:
  std::shared_ptr<const Platform> platform_;
  RrtOptions options_;
};

}  // namespace vantage
