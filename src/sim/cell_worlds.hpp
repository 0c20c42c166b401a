// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {

/// Solid (1) and empty (0) cells of 0.2 m, the first at the origin.
using SolidCells = VoxelGrid<std::uint8_t>;

inline constexpr double kWorldCellM = 0.2;

[[nodiscard]] SolidCells rooms_cells();
[[nodiscard]] SolidCells office_cells(const WorldOptions& options);
[[nodiscard]] SolidCells maze_cells(const WorldOptions& options);
[[nodiscard]] SolidCells two_storey_cells();

/// A world whose surfaces are those of the cells. The region is the box of the cells.
[[nodiscard]] World world_of_cells(std::string name, const SolidCells& solid);

}  // namespace vantage
