// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>

namespace VANTAGE_EXPORT vantage {

/// State of a cell. Unknown cells are never treated as free.
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

/// Any type that returns the state of a cell: OccupancyMap, a dense grid in a test, or the map of the host.
template <class Lookup>
concept OccupancyLookup = requires(const Lookup& lookup, const VoxelIndex& cell) {
  { lookup.at(cell) } -> std::same_as<Occupancy>;
};

/// Any type that returns the log-odds of a cell, nullopt if it is unknown. A cell with log-odds >= 0 is occupied.
template <class Lookup>
concept LogOddsLookup = requires(const Lookup& lookup, const VoxelIndex& cell) {
  { lookup.log_odds(cell) } -> std::same_as<std::optional<double>>;
};

}  // namespace vantage
