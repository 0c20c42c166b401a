// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/map/impl/sensor_frame.hpp>

namespace vantage::detail {

/// Classification of a ray; the first three are drawn.
enum class RayFate : std::int64_t { Hit, BeyondRange, NoReturn, NotFinite, ZeroLength, NotAddressable };

/// A block of 64 neighbouring rays of a scan, with their ends in the world frame.
struct RayBlock {
  static constexpr std::size_t kRays = 64;
  template <class T>
  using PerRay = std::array<T, kRays>;

  /// x, y, z of one point after the other.
  using Points = std::array<float, 3 * kRays>;

  alignas(64) Points point{};               ///< input: x, y, z of returns or directions in the sensor frame
  alignas(64) PerRay<std::int64_t> fate{};  ///< a RayFate per ray
  /// end points per axis, metres; the origin if a ray is not usable
  alignas(64) std::array<PerRay<double>, 3> end{};
  alignas(64) std::array<PerRay<std::int32_t>, 3> cell{};  ///< cells of the end points, per axis

  /// Whether the ray is drawn.
  [[nodiscard]] bool usable(std::size_t ray) const {
    return fate[ray] <= static_cast<std::int64_t>(RayFate::NoReturn);
  }
  /// Whether all rays end at a return.
  [[nodiscard]] bool all_hit() const {
    static_assert(static_cast<std::int64_t>(RayFate::Hit) == 0);
    std::int64_t any = 0;
    for (const std::int64_t one : fate) {
      any |= one;
    }
    return any == 0;
  }
  /// Whether the ray ends at a return.
  [[nodiscard]] bool hits(std::size_t ray) const { return fate[ray] == static_cast<std::int64_t>(RayFate::Hit); }
};

/// Transforms blocks of rays to the world frame.
struct RayPlacer {
  SensorFrame sensor;
  double max_range_m;
  double furthest_m;  ///< largest addressable coordinate of an end, metres; negative if no ray is addressable
  double size_m;      ///< edge length of a cell

  /// Computes `fate` and `end` from `point`: returns if `are_returns`, otherwise directions without a return.
  void place_ends(bool are_returns, RayBlock& block, InstructionSet set = best_instruction_set()) const;
  /// Computes `fate` and `end` for directions that are stored elsewhere.
  void place_ends(const RayBlock::Points& directions, RayBlock& block,
                  InstructionSet set = best_instruction_set()) const;
  /// Computes only the ends, for directions that are all usable. They are stored as x of all rays, then y, then z;
  /// `stretch` scales each direction to the full length of its ray.
  void place_ends(const std::array<RayBlock::PerRay<float>, 3>& directions, const RayBlock::PerRay<double>& stretch,
                  RayBlock& block, InstructionSet set = best_instruction_set()) const;
  /// Computes `cell` from `end`.
  void place_cells(RayBlock& block, InstructionSet set = best_instruction_set()) const;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/ray_block.ipp>
#endif
