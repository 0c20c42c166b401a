// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>

namespace VANTAGE_EXPORT vantage {

/// What the map knows of a cell. Unknown is not free.
enum class Occupancy : std::uint8_t { Unknown = 0, Free = 1, Occupied = 2 };

[[nodiscard]] constexpr std::string_view to_string(Occupancy occupancy) {
  switch (occupancy) {
    case Occupancy::Free:
      return "free";
    case Occupancy::Occupied:
      return "occupied";
    case Occupancy::Unknown:
      break;
  }
  return "unknown";
}

/// Anything that answers "what is at this cell": OccupancyMap, a dense grid in a test, a host's own map.
template <class Lookup>
concept OccupancyLookup = requires(const Lookup& lookup, const VoxelIndex& cell) {
  { lookup.at(cell) } -> std::same_as<Occupancy>;
};

}  // namespace vantage
