// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Range of a joint, radians or metres.
struct JointRange {
  double min = 0.0;  ///< lowest value
  double max = 0.0;  ///< highest value, >= min
};

/// Forward kinematics: the sensor pose `base_from_sensor` for these joint values. None if the configuration is not
/// valid, e.g. because of a self-collision.
using ForwardKinematics = std::function<std::optional<Pose>(std::span<const double> joints)>;

/// Resolution and number of samples of a CapabilityMap.
struct CapabilityMapOptions {
  double cell_m = 0.05;  ///< edge of a position cell, metres, > 0
  /// Direction bins along each edge of each face of a cube, in [1, 32]. 4 gives 96 bins of about 20 degrees.
  int direction_bins_per_edge = 4;
  std::size_t samples = 200'000;  ///< configurations drawn, > 0
  std::uint64_t seed = 1;         ///< seed of the random configurations
};

/// The directions in which a kinematic chain can point its sensor at each position, without inverse kinematics.
/// Positions are cells and directions are bins, both in the frame of the robot's base. The map is filled from random
/// configurations: what it contains is feasible up to the size of a cell and a bin; what it does not contain may be
/// feasible but was not drawn.
///
///     const CapabilityMap map(forward, ranges, {.cell_m = 0.025});
///     if (map.contains(position, direction)) ...
///
/// (Zacharias, Borst & Hirzinger 2007, as used by Dornhege & Kleiner 2011.)
class CapabilityMap {
 public:
  /// Draws each joint uniformly from its range. Throws std::invalid_argument, which names the invalid option, or if
  /// there is no joint, a range is not finite or has min > max, or no drawn configuration is valid.
  CapabilityMap(const ForwardKinematics& forward, std::span<const JointRange> ranges,
                const CapabilityMapOptions& options = {});

  /// Reads a file of `save`. Throws std::runtime_error with the path and the problem.
  [[nodiscard]] static CapabilityMap load(const std::filesystem::path& path);
  /// Writes the map to a file and replaces an existing one. Throws std::runtime_error with the path if that fails.
  void save(const std::filesystem::path& path) const;

  /// The options of the constructor.
  [[nodiscard]] const CapabilityMapOptions& options() const { return options_; }
  /// The grid of position cells in the base frame.
  [[nodiscard]] VoxelFrame frame() const { return {options_.cell_m}; }
  /// Bounding box of all cells in which the sensor was found.
  [[nodiscard]] const VoxelBox& cells() const { return cells_; }

  /// Whether the sensor can be in this cell, in any direction.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return directions_in(cell) > 0; }
  /// Whether the sensor can be in the cell of `position_m` (metres) and look into the bin of `direction` (any length)
  /// there; both in the base frame. False if one is not finite or the direction is zero.
  [[nodiscard]] bool contains(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const;
  /// Number of direction bins in which the sensor can look in this cell.
  [[nodiscard]] std::size_t directions_in(const VoxelIndex& cell) const;
  /// Unit vectors to the centres of these bins, in the base frame, by ascending bin.
  [[nodiscard]] std::vector<Eigen::Vector3d> directions_at(const VoxelIndex& cell) const;
  /// Number of cells in which the sensor can be.
  [[nodiscard]] std::size_t reachable_cells() const;

  /// Number of direction bins: 6 * direction_bins_per_edge^2.
  [[nodiscard]] std::size_t bin_count() const;
  /// The bin of a direction (any non-zero length) in the base frame.
  [[nodiscard]] std::size_t bin_of(const Eigen::Vector3d& direction) const;
  /// Unit vector to the centre of a bin, in the base frame. `bin` must be below `bin_count()`.
  [[nodiscard]] Eigen::Vector3d middle_of(std::size_t bin) const;

  /// Compares options, cells and directions.
  [[nodiscard]] bool operator==(const CapabilityMap& other) const;

 private:
  CapabilityMap() = default;
  [[nodiscard]] std::size_t words_per_cell() const { return (bin_count() + 63) / 64; }
  [[nodiscard]] std::span<const std::uint64_t> words_of(const VoxelIndex& cell) const;

  CapabilityMapOptions options_;
  VoxelBox cells_;
  std::vector<std::uint64_t>
      bits_;  // words_per_cell() words for each cell of cells_, x varies fastest; one bit per bin
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/capability_file.ipp>
#include <vantage/robot/impl/capability_map.ipp>
#endif
