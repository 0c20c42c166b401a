// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>

namespace VANTAGE_EXPORT vantage {

/// The integer address of a cell. Cell (x, y, z) covers [x r, (x + 1) r) on the x axis, and so on, where r is the
/// resolution. OctoMap uses the same alignment.
struct VoxelIndex {
  std::int32_t x = 0;  ///< index along x
  std::int32_t y = 0;  ///< index along y
  std::int32_t z = 0;  ///< index along z

  /// Lexicographic order by x, y, z.
  friend constexpr auto operator<=>(const VoxelIndex&, const VoxelIndex&) = default;
  /// Component-wise sum.
  friend constexpr VoxelIndex operator+(const VoxelIndex& a, const VoxelIndex& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  /// Component-wise difference.
  friend constexpr VoxelIndex operator-(const VoxelIndex& a, const VoxelIndex& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

/// Largest absolute value of a valid coordinate. The sum of two valid coordinates fits into 32 bits.
inline constexpr std::int32_t kFurthestVoxel = (1 << 30) - 1;

/// Offsets to the six face neighbours, in the order -x +x -y +y -z +z.
inline constexpr std::array<VoxelIndex, 6> kFaceNeighbours{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Whether all coordinates of a cell are within kFurthestVoxel.
[[nodiscard]] constexpr bool is_addressable(const VoxelIndex& cell) {
  const auto near = [](std::int32_t i) { return i >= -kFurthestVoxel && i <= kFurthestVoxel; };
  return near(cell.x) && near(cell.y) && near(cell.z);
}

namespace detail {
/// Clamps a length in cells to kFurthestVoxel; NaN becomes -kFurthestVoxel.
[[nodiscard]] constexpr double within_addresses(double cells) {
  constexpr double kFurthest = kFurthestVoxel;
  const double above = cells > -kFurthest ? cells : -kFurthest;
  return above < kFurthest ? above : kFurthest;
}
/// Converts a length in cells to a coordinate: clamps it, then rounds towards zero. All conversions use this
/// function.
[[nodiscard]] constexpr std::int32_t to_address(double cells) {
  return static_cast<std::int32_t>(within_addresses(cells));
}

consteval std::array<VoxelIndex, 26> all_neighbours() {
  std::array<VoxelIndex, 26> neighbours{};
  std::size_t count = 0;
  for (std::int32_t z = -1; z <= 1; ++z) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      for (std::int32_t x = -1; x <= 1; ++x) {
        if (x != 0 || y != 0 || z != 0) {
          neighbours[count++] = {x, y, z};
        }
      }
    }
  }
  return neighbours;
}
}  // namespace detail

/// Offsets to the 26 neighbours that share a face, an edge or a corner; x fastest.
inline constexpr std::array<VoxelIndex, 26> kAllNeighbours = detail::all_neighbours();

/// A half-open box of cells: `lo` is inside, `hi` is outside. A default box is empty.
struct VoxelBox {
  VoxelIndex lo;  ///< lowest cell, inside
  VoxelIndex hi;  ///< one past the highest cell on each axis

  /// Whether both corners are equal.
  friend constexpr bool operator==(const VoxelBox&, const VoxelBox&) = default;
  /// Whether the box contains no cell.
  [[nodiscard]] constexpr bool empty() const { return hi.x <= lo.x || hi.y <= lo.y || hi.z <= lo.z; }
  /// Whether the cell is inside.
  [[nodiscard]] constexpr bool contains(const VoxelIndex& cell) const {
    return cell.x >= lo.x && cell.x < hi.x && cell.y >= lo.y && cell.y < hi.y && cell.z >= lo.z && cell.z < hi.z;
  }
  /// Number of cells along each axis; at most 2^31 - 1, which every box of addressable cells keeps to.
  [[nodiscard]] constexpr VoxelIndex extent() const {
    return empty() ? VoxelIndex{} : VoxelIndex{length(lo.x, hi.x), length(lo.y, hi.y), length(lo.z, hi.z)};
  }
  /// Number of cells; at most 2^64 - 1.
  [[nodiscard]] constexpr std::size_t size() const {
    const VoxelIndex e = extent();
    const auto z = static_cast<std::uint64_t>(e.z);
    const std::uint64_t layer = static_cast<std::uint64_t>(e.x) * static_cast<std::uint64_t>(e.y);  // below 2^62
    const std::uint64_t above = (layer >> 32U) * z + ((layer & 0xFFFFFFFFU) * z >> 32U);  // the product over 2^32
    return above >> 32U != 0 ? std::numeric_limits<std::size_t>::max() : layer * z;
  }
  /// The box grown by `cells` on every side.
  [[nodiscard]] constexpr VoxelBox grown(std::int32_t cells) const {
    return {lo - VoxelIndex{cells, cells, cells}, hi + VoxelIndex{cells, cells, cells}};
  }

 private:
  // Unsigned, because the difference of two coordinates may need 32 bits and a sign.
  static constexpr std::int32_t length(std::int32_t from, std::int32_t to) {
    constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max();
    const std::uint32_t difference = static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from);
    return static_cast<std::int32_t>(difference < kMost ? difference : kMost);
  }
};

/// Calls `visit(VoxelIndex)` for every cell of `box`, x fastest, then y, then z.
template <class Visit>
void for_each_cell(const VoxelBox& box, Visit&& visit) {
  for (std::int32_t z = box.lo.z; z < box.hi.z; ++z) {
    for (std::int32_t y = box.lo.y; y < box.hi.y; ++y) {
      for (std::int32_t x = box.lo.x; x < box.hi.x; ++x) {
        visit(VoxelIndex{x, y, z});
      }
    }
  }
}

/// Converts between metres (world frame) and cells; no other code does. Coordinates beyond kFurthestVoxel are clamped
/// per axis, and NaN becomes the lowest coordinate. Call `addressable` first to detect this.
struct VoxelFrame {
  double size_m;  ///< edge length of a cell, metres, > 0

  /// The cell that holds `point_m`.
  [[nodiscard]] VoxelIndex cell_of(const Eigen::Vector3d& point_m) const {
    return {coordinate_of(point_m.x()), coordinate_of(point_m.y()), coordinate_of(point_m.z())};
  }
  /// Whether `point_m` is finite and lies within the addressable range.
  [[nodiscard]] bool addressable(const Eigen::Vector3d& point_m) const {
    const double furthest_m = size_m * kFurthestVoxel;
    return (point_m.array().abs() <= furthest_m).all();  // false for NaN
  }
  /// Lower corner of a cell, metres.
  [[nodiscard]] Eigen::Vector3d corner_of(const VoxelIndex& cell) const {
    return Eigen::Vector3d(cell.x, cell.y, cell.z) * size_m;
  }
  /// Centre of a cell, metres.
  [[nodiscard]] Eigen::Vector3d centre_of(const VoxelIndex& cell) const {
    return Eigen::Vector3d(cell.x + 0.5, cell.y + 0.5, cell.z + 0.5) * size_m;
  }
  /// The space covered by a cell, metres.
  [[nodiscard]] Box box_of(const VoxelIndex& cell) const {
    return {corner_of(cell), corner_of(cell + VoxelIndex{1, 1, 1})};
  }
  /// The space covered by a box of cells, metres.
  [[nodiscard]] Box box_of(const VoxelBox& cells) const { return {corner_of(cells.lo), corner_of(cells.hi)}; }
  /// The cells whose centre lies in `box` (half-open).
  [[nodiscard]] VoxelBox cells_centred_in(const Box& box) const {
    const auto first = [this](double metres) { return detail::to_address(std::ceil(metres / size_m - 0.5)); };
    if (box.empty()) {
      return {};
    }
    return {{first(box.min.x()), first(box.min.y()), first(box.min.z())},
            {first(box.max.x()), first(box.max.y()), first(box.max.z())}};
  }
  /// The cells that overlap `box` (half-open).
  [[nodiscard]] VoxelBox cells_touched_by(const Box& box) const {
    return box.empty() ? VoxelBox{}
                       : VoxelBox{cell_of(box.min),
                                  {cells_up_to(box.max.x()), cells_up_to(box.max.y()), cells_up_to(box.max.z())}};
  }
  /// Number of cells in a length, rounded up.
  [[nodiscard]] std::int32_t cells_up_to(double metres) const {
    return detail::to_address(std::ceil(metres / size_m));
  }

 private:
  [[nodiscard]] std::int32_t coordinate_of(double metres) const {
    const double cells = detail::within_addresses(metres / size_m);
    // faster than std::floor, which is a function call before SSE 4.1
    const std::int32_t towards_zero = detail::to_address(cells);
    return towards_zero - (towards_zero > cells ? 1 : 0);
  }
};

}  // namespace vantage

/// \cond
/// Hash of a cell address, for unordered containers.
template <>
struct std::hash<vantage::VoxelIndex> {
  std::size_t operator()(const vantage::VoxelIndex& cell) const noexcept {
    std::uint64_t h = static_cast<std::uint32_t>(cell.x) * 0x9E3779B97F4A7C15ULL;
    h ^= static_cast<std::uint32_t>(cell.y) * 0xC2B2AE3D27D4EB4FULL;
    h ^= static_cast<std::uint32_t>(cell.z) * 0x165667B19E3779F9ULL;
    return h ^ (h >> 29);
  }
};
/// \endcond
