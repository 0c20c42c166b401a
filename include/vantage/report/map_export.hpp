// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The surface of the occupied cells as a mesh in a PLY file (binary): every face towards a cell that is not
/// occupied, two triangles each, seen counter-clockwise from outside, corners shared, coloured by height. Metres, +z
/// up. Throws std::runtime_error naming the file if it cannot be written.
void write_ply_mesh(const OccupancyMap& map, const std::filesystem::path& file);

/// The centres of the occupied cells as points in a PLY file (binary), coloured by height. Errors as write_ply_mesh.
void write_ply_points(const OccupancyMap& map, const std::filesystem::path& file);

/// A recorded run as time series for ParaView, one moment per plan and one for the last view, the number of the view
/// being the time. In `folder`, which must exist: occupancy.pvd (grids; 0 unknown, 1 free, 2 occupied), frontiers.pvd
/// (points), path.pvd (lines; `planned` tells the way ahead from the way behind) and, where the planner has a field,
/// field.pvd (points with `phi` and `downhill`), with their parts in folders of the same names. Returns the four or
/// three .pvd files. Throws std::runtime_error naming what cannot be read or written.
std::vector<std::filesystem::path> write_paraview(const std::filesystem::path& record,
                                                  const std::filesystem::path& folder);

}  // namespace vantage
