// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

namespace vantage::detail {

/// The volume of unknown space that may be seen from a place, by sparse rays all around. A ray passes unknown cells
/// and ends at the first occupied one, at the end of the region or of the range.
///
///     column 0   1   2  ...        rays of a column have one yaw and the elevations of the sensor's rows
class UnknownVolume {
 public:
  /// Number of yaws.
  static constexpr std::size_t kColumns = 36;

  /// For rays of this sensor up to `range_m` at most. A map of one layer gets level rays.
  UnknownVolume(const OccupancyMap& map, const RangeSensor& sensor);

  /// The unknown volume in each column from `position` (metres, world), cubic metres. Adds the number of visited
  /// cells to `operations`.
  [[nodiscard]] std::vector<double> columns(const Eigen::Vector3d& position, std::uint64_t& operations) const;
  /// The volume in the field of view of a sensor that looks along the middle of this column.
  [[nodiscard]] double in_view(const std::vector<double>& columns, std::size_t yaw) const;
  /// The level direction of a column.
  [[nodiscard]] static Eigen::Vector3d direction(std::size_t column);
  /// What a view shows if all in its range is unknown.
  [[nodiscard]] double most() const { return most_; }
  /// The length of the rays, metres.
  [[nodiscard]] double range_m() const { return range_m_; }

 private:
  const OccupancyMap& map_;
  double range_m_;
  std::vector<double> elevations_rad_;
  std::size_t beside_;  // columns in view on each side of the middle one
  double solid_angle_;  // of a ray in the horizon
  double most_ = 0.0;
};

}  // namespace vantage::detail
