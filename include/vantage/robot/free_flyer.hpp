// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// Radius, safety margin, height limits and tilt of a FreeFlyer.
struct FreeFlyerOptions {
  /// Radius of the body, a sphere around the sensor, metres, in [0, 1000] (0: the sensor's cell)
  double radius_m = 0.3;
  double min_height_m = -std::numeric_limits<double>::infinity();  ///< lowest admitted z of the sensor, metres, world
  double max_height_m = std::numeric_limits<double>::infinity();  ///< highest admitted z of the sensor, metres, world
  /// Additional distance around the body in which cells must be clear, metres, in [0, 1000]. None: as much as makes
  /// radius and margin a cell of the map, because a free cell may contain a part of a wall.
  std::optional<double> margin_m = std::nullopt;
  bool yaw_only = false;  ///< true: the optical axis stays horizontal, e.g. a multirotor with a fixed camera
};

/// A flying sphere around the sensor. All cells that it touches must be clear: free and not contested
/// (OccupancyMap::is_clear).
class FreeFlyer final : public Platform {
 public:
  FreeFlyer() : FreeFlyer(FreeFlyerOptions{}) {}
  /// Throws std::invalid_argument, which names the invalid option.
  explicit FreeFlyer(const FreeFlyerOptions& options);

  /// The options of the constructor.
  [[nodiscard]] const FreeFlyerOptions& options() const { return options_; }

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
  [[nodiscard]] bool can_tilt() const override { return !options_.yaw_only; }

 private:
  [[nodiscard]] bool height_allowed(double z_m) const {
    return z_m >= options_.min_height_m && z_m <= options_.max_height_m;
  }
  [[nodiscard]] bool has_room(const OccupancyMap& map, const Eigen::Vector3d& position) const;
  FreeFlyerOptions options_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/free_flyer.ipp>
#endif
