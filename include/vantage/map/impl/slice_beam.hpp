// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/map/impl/ray_block.hpp>

namespace vantage::detail {

/// The axes of a class of rays: those that advance fastest along the same axis, in the same direction.
struct SliceAxes {
  std::size_t major = 0;  ///< axis across the slices
  std::size_t u = 1;      ///< first lateral axis
  std::size_t v = 2;      ///< second lateral axis
  bool up = true;         ///< whether the rays go towards larger coordinates along the major axis

  /// Converts coordinates along (major, u, v) to (x, y, z), for cells or words.
  [[nodiscard]] VoxelIndex at(std::int32_t m, std::int32_t of_u, std::int32_t of_v) const {
    return major == 0   ? VoxelIndex{m, of_u, of_v}
           : major == 1 ? VoxelIndex{of_u, m, of_v}
                        : VoxelIndex{of_u, of_v, m};
  }
};

/// The class of a ray that advances by these coordinates: twice its major axis (the first of the fastest), plus one
/// if it goes up. It has no branches, so that loops over rays are vectorised.
[[nodiscard]] inline std::int32_t class_of_ray(double x, double y, double z) {
  const double by_x = x > 0.0 ? 1.0 : 0.0;
  const double by_y = y > 0.0 ? 3.0 : 2.0;
  const double by_z = z > 0.0 ? 5.0 : 4.0;
  const double of_y_or_z = std::abs(y) >= std::abs(z) ? by_y : by_z;
  const double y_or_z = std::abs(y) >= std::abs(z) ? std::abs(y) : std::abs(z);
  return static_cast<std::int32_t>(std::abs(x) >= y_or_z ? by_x : of_y_or_z);
}

/// The ends of 64 rays relative to their origin, along x, y and z, in cells.
using RayExtents = std::array<RayBlock::PerRay<double>, 3>;

/// Computes the extents of the rays of a block.
void measure(const RayBlock& block, const Eigen::Vector3d& origin, double size_m, RayExtents& extents,
             InstructionSet set);

/// 64 rays of one class from one origin as lines: lateral position as a function of the distance along the major
/// axis.
struct RayLines {
  /// Computes the lines of rays of these axes from their ends. The length of a ray that goes the other way is
  /// negative.
  void place(const RayExtents& extents, const SliceAxes& axes, InstructionSet set);

  alignas(64) std::array<RayBlock::PerRay<double>, 2> slope;  ///< lateral cells per cell along the major axis
  alignas(64) RayBlock::PerRay<double> length{};              ///< distance of the end along the major axis, in cells
};

/// A rectangle of cells along the two lateral axes; `lo` and `hi` are both included.
struct LateralCells {
  std::array<std::int32_t, 2> lo;
  std::array<std::int32_t, 2> hi;

  /// Number of cells along a lateral axis.
  [[nodiscard]] std::int32_t extent(std::size_t lateral) const { return hi[lateral] - lo[lateral] + 1; }
};

/// A beam: a bound on neighbouring rays of one class from one origin. It tells in which cells of each slice the rays
/// may be. A slice is one sheet of cells across the major axis; slice 0 holds the origin. A layer is the slices of
/// one sheet of words of 4 x 4 x 4 cells.
///
///     v ^  slice 0     1     2     3  |  4     5     6     7
///       |                             |                ...''''    upper edge of the beam: slope `most`
///       |                             |     .....''''#
///       |              .....''''''''''|'''''   #     #            #  a cell that stops rays (it is not known free)
///       |   ....'''''''               |        #
///       |  o                          |                           o  origin: the sensor
///       |   ''''''''''.....           |
///       |                  ''''''.....|.......                    lower edge of the beam: slope `least`
///       |                             |       '''''''''''...
///       +-----------------------------+-----------------------> major axis
///            layer (4 slices)         |     layer (4 slices)
struct SliceBeam {
  /// Tolerance for lateral positions, in cells. The positions of a beam and of an exact walk differ by much less.
  static constexpr double kRounding = 1e-6;

  SliceBeam() = default;
  /// All rays of a class (class_of_ray) from `origin`.
  SliceBeam(const VoxelFrame& frame, const Eigen::Vector3d& origin, std::int32_t of_class);

  /// Coordinate of a slice along the major axis. Slice 0 contains the origin.
  [[nodiscard]] std::int32_t along(std::int64_t slice) const {
    return first_along + static_cast<std::int32_t>(axes.up ? slice : -slice);
  }
  /// Number of slices from this one to the end of its layer, this one included.
  [[nodiscard]] std::int32_t left_in_layer(std::int64_t slice) const {
    return axes.up ? 4 - (along(slice) & 3) : (along(slice) & 3) + 1;
  }
  /// Distance from the origin, in cells along the major axis, at which rays enter a slice.
  [[nodiscard]] double entered_at(std::int64_t slice) const {
    const double entered = static_cast<double>(slice) - from_entry;
    return entered > 0.0 ? entered : 0.0;
  }
  /// Position of the origin along the major axis, from the lower face of slice 0, in [0, 1].
  [[nodiscard]] double within_major() const { return axes.up ? from_entry : 1.0 - from_entry; }
  /// The lateral cells in which rays may be, from the first to the last of some slices.
  [[nodiscard]] LateralCells cells_in(std::int64_t first_slice, std::int64_t last_slice) const {
    const double enters = entered_at(first_slice);
    const double leaves = entered_at(last_slice + 1);
    LateralCells cells{};
    for (std::size_t i = 0; i < 2; ++i) {
      cells.lo[i] = first[i] + cell_at(within[i] + least[i] * (least[i] < 0.0 ? leaves : enters) - kRounding);
      cells.hi[i] = first[i] + cell_at(within[i] + most[i] * (most[i] > 0.0 ? leaves : enters) + kRounding);
    }
    return cells;
  }
  /// Shrinks the beam to these rays.
  void tighten(const RayLines& lines, std::uint64_t active, InstructionSet set);
  /// Whether the beam contains no ray.
  [[nodiscard]] bool is_empty() const { return least[0] > most[0] || least[1] > most[1]; }
  /// The last slice that overlaps a box.
  [[nodiscard]] std::int64_t last_slice_of(const VoxelBox& box) const;

  /// The cell of a position along an axis, rounded down. Clamped to the addressable range.
  [[nodiscard]] static std::int32_t cell_at(double place) {
    constexpr auto kFurthest = static_cast<double>(kFurthestVoxel);
    const double no_less = place > -kFurthest ? place : -kFurthest;
    const double cell = no_less < kFurthest ? no_less : kFurthest;
    const auto towards_zero = static_cast<std::int32_t>(cell);
    return towards_zero - (towards_zero > cell ? 1 : 0);
  }

  SliceAxes axes;
  std::int32_t first_along = 0;  ///< coordinate of slice 0 along the major axis
  double from_entry = 0.0;  ///< distance from the face through which rays would enter slice 0 to the origin, in cells
  std::array<std::int32_t, 2> first{};        ///< cell of the origin along the lateral axes
  std::array<double, 2> within{};             ///< position of the origin in that cell, in [0, 1]
  std::array<double, 2> least{{-1.0, -1.0}};  ///< smallest slope: lateral cells per cell along the major axis
  std::array<double, 2> most{{1.0, 1.0}};     ///< largest slope
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/slice_beam.ipp>
#endif
