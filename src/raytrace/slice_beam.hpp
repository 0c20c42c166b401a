// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map/instruction_set.hpp>
#include <raytrace/tile_hits.hpp>
#include <vantage/geometry/voxel.hpp>

namespace vantage {

/// The lateral cells that rays may be in, first and last.
struct LateralCells {
  std::array<std::int32_t, 2> lo;
  std::array<std::int32_t, 2> hi;

  /// How many there are along a lateral axis.
  [[nodiscard]] std::int32_t extent(std::size_t lateral) const { return hi[lateral] - lo[lateral] + 1; }
};

/// The same for some layers of words, one after the other on the way of rays, each with as many slices.
struct LateralLayers {
  static constexpr std::size_t kLayers = 8;
  template <class T>
  using PerLayer = std::array<T, kLayers>;

  /// Those of a layer.
  [[nodiscard]] LateralCells operator[](std::size_t layer) const {
    return {{lo[0][layer], lo[1][layer]}, {hi[0][layer], hi[1][layer]}};
  }

  alignas(32) std::array<PerLayer<std::int32_t>, 2> lo{};
  alignas(32) std::array<PerLayer<std::int32_t>, 2> hi{};
};

/// Neighbouring rays from one origin that advance fastest along the same axis, in the same direction: through which
/// slices they go, and in which cells of them they may be.
struct SliceBeam {
  /// Lateral places of rays differ from those of a walk by less than this, in cells: far more than its clock and sums
  /// of doubles can.
  static constexpr double kRounding = 1e-6;

  SliceBeam() = default;
  /// Of rays from `origin`, along the axis `major`, towards its upper end or not; of any lateral spread.
  SliceBeam(const VoxelFrame& frame, const Eigen::Vector3d& origin, std::size_t major, bool up);

  /// Coordinate of the cells of a slice along the major axis; slice 0 is that of the origin.
  [[nodiscard]] std::int32_t along(std::int64_t slice) const {
    return first_along + static_cast<std::int32_t>(axes.up ? slice : -slice);
  }
  /// How many slices there are from this one on in its layer of words.
  [[nodiscard]] std::int32_t left_in_layer(std::int64_t slice) const {
    return axes.up ? 4 - (along(slice) & 3) : (along(slice) & 3) + 1;
  }
  /// How far from the origin along the major axis rays enter a slice, in cells.
  [[nodiscard]] double entered_at(std::int64_t slice) const {
    const double entered = static_cast<double>(slice) - from_entry;
    return entered > 0.0 ? entered : 0.0;
  }
  /// Place of the origin in slice 0 along the major axis, in [0, 1], from its lower face.
  [[nodiscard]] double within_major() const { return axes.up ? from_entry : 1.0 - from_entry; }
  /// The lateral cells that rays may be in from the first to the last of some slices.
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
  /// The same for the layer of this slice, from it on, and those behind it; of a slice after that of the origin, up
  /// to kLastOfLayers.
  [[nodiscard]] LateralLayers layers_from(std::int64_t slice, InstructionSet set) const;
  static constexpr std::int64_t kLastOfLayers = 1 << 19;
  /// Whether no ray can be in it.
  [[nodiscard]] bool is_empty() const { return least[0] > most[0] || least[1] > most[1]; }
  /// The last slice in which a ray may be in a box.
  [[nodiscard]] std::int64_t last_slice_of(const VoxelBox& box) const;

  /// The cell of a place along an axis, rounded down; the furthest there is, if it is further.
  [[nodiscard]] static std::int32_t cell_at(double place) {
    constexpr auto kFurthest = static_cast<double>(kFurthestVoxel);
    const double no_less = place > -kFurthest ? place : -kFurthest;
    const double cell = no_less < kFurthest ? no_less : kFurthest;
    const auto towards_zero = static_cast<std::int32_t>(cell);
    return towards_zero - (towards_zero > cell ? 1 : 0);
  }

  SlicePlace axes;                            ///< only its axes mean anything
  std::int32_t first_along = 0;               ///< coordinate of slice 0
  double from_entry = 0.0;                    ///< of the origin, to where it would have entered slice 0, in cells
  std::array<std::int32_t, 2> first{};        ///< cell of the origin along the lateral axes
  std::array<double, 2> within{};             ///< place of the origin in that cell, in [0, 1]
  std::array<double, 2> least{{-1.0, -1.0}};  ///< lateral cells per cell along the major axis, no less than
  std::array<double, 2> most{{1.0, 1.0}};     ///< this, and no more
};

}  // namespace vantage
