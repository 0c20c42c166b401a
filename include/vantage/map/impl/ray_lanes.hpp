// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/instruction_set.hpp>

namespace vantage::detail {

/// Eight rays that walk through a window of cells in parallel, one step at a time.
///
/// This is the traversal of VoxelRay without branches, because the next axis to step is unpredictable. The position
/// of a cell in a bit plane is the sum of three coordinates, whose bits are spread to the bits of their axis. A step
/// adds a constant and masks the result:
///
///     at' = (at + step) & mask,   step = ~mask + unit (up) or -unit (down)
///
/// where `unit` is the lowest bit of the axis. In `step` the bits of the other axes are set, so the carry passes over
/// them.
struct RayLanes {
  static constexpr std::size_t kLanes = 8;
  template <class T>
  using PerLane = std::array<T, kLanes>;

  alignas(64) std::array<PerLane<std::int64_t>, 3> next{};   ///< per axis: time of the next face
  alignas(64) std::array<PerLane<std::int64_t>, 3> delta{};  ///< per axis: time between faces
  alignas(64) std::array<PerLane<std::int64_t>, 3> at{};     ///< per axis: spread coordinate
  alignas(64) std::array<PerLane<std::int64_t>, 3> step{};   ///< per axis: spread +1 or -1, with carry bits
  alignas(64) PerLane<std::int64_t> base{};                  ///< added to the position; parks a lane without a ray
  std::array<std::int64_t, 3> mask{};                        ///< per axis: bits of a position that belong to it

  /// Repeats `steps` times: marks the current cell of every lane in `plane`, then steps.
  void walk(std::int64_t steps, std::uint64_t* plane, InstructionSet set = best_instruction_set());
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/ray_lanes.ipp>
#endif
