// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map/instruction_set.hpp>
#include <map/sensor_frame.hpp>

namespace vantage {

/// What becomes of a ray.
enum class RayFate : std::int64_t { Hit, BeyondRange, NoReturn, NotFinite, ZeroLength, NotAddressable };

/// 64 neighbouring rays of a scan, in the world.
struct RayBlock {
  static constexpr std::size_t kRays = 64;
  template <class T>
  using PerRay = std::array<T, kRays>;

  /// Three coordinates of one after the other.
  using Points = std::array<float, 3 * kRays>;

  alignas(64) Points point{};                       ///< in: x, y, z of returns or directions, sensor frame
  alignas(64) PerRay<std::int64_t> fate{};          ///< a RayFate
  alignas(64) std::array<PerRay<double>, 3> end{};  ///< metres; that of the origin for a ray that cannot be used
  alignas(64) std::array<PerRay<std::int32_t>, 3> cell{};  ///< of the end

  /// Whether the ray is drawn.
  [[nodiscard]] bool usable(std::size_t ray) const {
    return fate[ray] <= static_cast<std::int64_t>(RayFate::NoReturn);
  }
  /// Whether all rays end by a return.
  [[nodiscard]] bool all_hit() const {
    static_assert(static_cast<std::int64_t>(RayFate::Hit) == 0);
    std::int64_t any = 0;
    for (const std::int64_t one : fate) {
      any |= one;
    }
    return any == 0;
  }
  /// Whether the ray ends by a return.
  [[nodiscard]] bool hits(std::size_t ray) const { return fate[ray] == static_cast<std::int64_t>(RayFate::Hit); }
};

/// Puts blocks of rays into the world.
struct RayPlacer {
  SensorFrame sensor;
  double max_range_m;
  double furthest_m;  ///< of an end that can be addressed, along an axis; negative: none can
  double size_m;      ///< of a cell

  /// From `point`, returns or directions without one, to `fate` and `end`.
  void place_ends(bool are_returns, RayBlock& block, InstructionSet set = best_instruction_set()) const;
  /// The same for directions that lie elsewhere.
  void place_ends(const RayBlock::Points& directions, RayBlock& block,
                  InstructionSet set = best_instruction_set()) const;
  /// The ends alone of directions that are all usable, x of all of them first, then y, then z; each is made as long
  /// as rays reach by its `stretch`.
  void place_ends(const std::array<RayBlock::PerRay<float>, 3>& directions, const RayBlock::PerRay<double>& stretch,
                  RayBlock& block, InstructionSet set = best_instruction_set()) const;
  /// From `end` to `cell`.
  void place_cells(RayBlock& block, InstructionSet set = best_instruction_set()) const;
};

}  // namespace vantage
