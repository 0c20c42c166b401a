// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// The body of a GroundRobot.
struct GroundRobotOptions {
  double radius_m = 0.3;  ///< the body is a disc about the sensor, in [0, 1000] (0: the sensor's own cell)
  /// Cells this much further off must be free too, in [0, 1000]: a free cell may hold a corner of a wall.
  double margin_m = 0.0;
};

/// A disc that drives in one layer of cells, its sensor level: for the plane of a HeightBand, in which every cell
/// speaks for all heights of the robot. Only cells of the sensor's own layer count; each that the disc touches must
/// be known free and not contested.
class GroundRobot final : public Platform {
 public:
  GroundRobot() : GroundRobot(GroundRobotOptions{}) {}
  /// Throws std::invalid_argument naming the option at fault.
  explicit GroundRobot(const GroundRobotOptions& options);

  /// The options it was made with.
  [[nodiscard]] const GroundRobotOptions& options() const { return options_; }

  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override;
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override;
  [[nodiscard]] VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const override;
  [[nodiscard]] double reach_m() const override { return options_.radius_m + options_.margin_m; }
  [[nodiscard]] bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override;
  [[nodiscard]] Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const override;
  [[nodiscard]] double distance_m(const Pose& from, const Pose& to) const override;
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override;
  [[nodiscard]] Box body_box(const Pose& pose) const override;
  [[nodiscard]] bool can_tilt() const override { return false; }

 private:
  GroundRobotOptions options_;
};

}  // namespace vantage
