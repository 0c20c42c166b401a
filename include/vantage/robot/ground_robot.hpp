// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// Radius and safety margin of the body of a GroundRobot.
struct GroundRobotOptions {
  /// Radius of the body, a disc around the sensor, metres, in [0, 1000] (0: the sensor's cell)
  double radius_m = 0.3;
  /// Additional distance around the body in which cells must be clear, metres, in [0, 1000]. None: as much as makes
  /// radius and margin a cell of the map, because a free cell may contain a part of a wall.
  std::optional<double> margin_m = std::nullopt;
};

/// A disc that drives in one layer of cells, with a horizontal optical axis. Meant for HeightBand::plane, whose cells
/// represent all heights of the robot. Only cells in the layer of the sensor count: all that the disc touches must be
/// clear (free and not contested).
class GroundRobot final : public Platform {
 public:
  GroundRobot() : GroundRobot(GroundRobotOptions{}) {}
  /// Throws std::invalid_argument, which names the invalid option.
  explicit GroundRobot(const GroundRobotOptions& options);

  /// The options of the constructor.
  [[nodiscard]] const GroundRobotOptions& options() const { return options_; }

  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override;
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override;
  [[nodiscard]] VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const override;
  [[nodiscard]] double reach_m() const override { return options_.radius_m + options_.margin_m.value_or(0.0); }
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

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/ground_robot.ipp>
#endif
