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

/// The values a joint can take, radians or metres.
struct JointRange {
  double min = 0.0;  ///< lowest value
  double max = 0.0;  ///< highest value, >= min
};

/// Where the sensor is when the joints have these values, `base_from_sensor`; none where the robot cannot take them
/// (it would touch itself, say).
using ForwardKinematics = std::function<std::optional<Pose>(std::span<const double> joints)>;

/// How a CapabilityMap is made.
struct CapabilityMapOptions {
  double cell_m = 0.05;  ///< edge of a cell of positions, > 0
  /// Directions are told apart by a grid of this many by this many on each side of a cube, in [1, 32]: 4 makes 96
  /// bins of about 20 degrees.
  int direction_bins_per_edge = 4;
  std::size_t samples = 200'000;  ///< configurations drawn, > 0
  std::uint64_t seed = 1;         ///< of the drawing
};

/// What a kinematic chain can do with its sensor, asked without inverse kinematics: for each cell of positions in the
/// base's frame, the directions in which the sensor was found able to look there (Zacharias, Borst & Hirzinger 2007,
/// as Dornhege & Kleiner 2011 use it). It is filled from configurations drawn at random, so what it holds can be
/// done, up to the size of a cell and a bin; what it does not hold was never drawn.
///
///     const CapabilityMap map(forward, ranges, {.cell_m = 0.025});
///     if (map.contains(position, direction)) ...
class CapabilityMap {
 public:
  /// Draws each joint evenly from its range. Throws std::invalid_argument naming the option at fault, or if there is
  /// no joint, a range is empty, or no configuration drawn can be taken.
  CapabilityMap(const ForwardKinematics& forward, std::span<const JointRange> ranges,
                const CapabilityMapOptions& options = {});

  /// Reads what `save` wrote. Throws std::runtime_error naming the path and what is wrong.
  [[nodiscard]] static CapabilityMap load(const std::filesystem::path& path);
  /// Writes the map to a file, replacing it. Throws std::runtime_error naming the path if it cannot be written.
  void save(const std::filesystem::path& path) const;

  /// The options it was made with.
  [[nodiscard]] const CapabilityMapOptions& options() const { return options_; }
  /// Where cells lie in the base's frame.
  [[nodiscard]] VoxelFrame frame() const { return {options_.cell_m}; }
  /// The smallest box that holds every cell the sensor can be in.
  [[nodiscard]] const VoxelBox& cells() const { return cells_; }

  /// Whether the sensor can be in this cell, looking somewhere.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return directions_in(cell) > 0; }
  /// Whether the sensor can be in the cell of `position_m` and look into the bin of `direction` (any non-zero length)
  /// there; both in the base's frame.
  [[nodiscard]] bool contains(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const;
  /// How many bins of directions the sensor can look into in this cell.
  [[nodiscard]] std::size_t directions_in(const VoxelIndex& cell) const;
  /// Unit vectors to the middles of these bins, in the order of their numbers.
  [[nodiscard]] std::vector<Eigen::Vector3d> directions_at(const VoxelIndex& cell) const;
  /// How many cells the sensor can be in.
  [[nodiscard]] std::size_t reachable_cells() const;

  /// How many bins of directions there are: six sides of a cube.
  [[nodiscard]] std::size_t bin_count() const;
  /// The bin of a direction (any non-zero length).
  [[nodiscard]] std::size_t bin_of(const Eigen::Vector3d& direction) const;
  /// Unit vector to the middle of a bin, which must be below `bin_count()`.
  [[nodiscard]] Eigen::Vector3d middle_of(std::size_t bin) const;

  /// The same options, cells and directions.
  [[nodiscard]] bool operator==(const CapabilityMap& other) const;

 private:
  CapabilityMap() = default;
  [[nodiscard]] std::size_t words_per_cell() const { return (bin_count() + 63) / 64; }
  [[nodiscard]] std::span<const std::uint64_t> words_of(const VoxelIndex& cell) const;

  CapabilityMapOptions options_;
  VoxelBox cells_;
  std::vector<std::uint64_t> bits_;  // words_per_cell() for each cell of cells_, x running fastest: a bit per bin
};

}  // namespace vantage
