// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map/instruction_set.hpp>

namespace vantage {

/// Eight rays that walk through a window of cells together, one step each at a time.
///
/// It is the traversal of VoxelRay without branches: which axis steps next cannot be predicted. A cell is the sum of
/// three coordinates whose bits are spread to where they belong in the position of the cell in a plane: stepping is
/// adding with a carry that jumps over the bits of the other axes.
struct RayLanes {
  static constexpr std::size_t kLanes = 8;
  template <class T>
  using PerLane = std::array<T, kLanes>;

  alignas(64) std::array<PerLane<std::int64_t>, 3> next{};   ///< time of the next face crossed, per axis
  alignas(64) std::array<PerLane<std::int64_t>, 3> delta{};  ///< time from face to face
  alignas(64) std::array<PerLane<std::int64_t>, 3> at{};     ///< spread coordinate
  alignas(
      64) std::array<PerLane<std::int64_t>, 3> step{};  ///< what is added to it: one, or minus one, with its carry
  alignas(64) PerLane<std::int64_t> base{};             ///< added to the position: parks a lane without a ray
  std::array<std::int64_t, 3> mask{};                   ///< bits of the position that belong to each axis

  /// Marks the cell of every lane in `plane`, then steps; `steps` times.
  void walk(std::int64_t steps, std::uint64_t* plane, InstructionSet set = best_instruction_set());
};

}  // namespace vantage
