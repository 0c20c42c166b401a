// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Writes the surface of the occupied cells as a mesh into a binary PLY file: every face towards a cell that is
/// not occupied, as two triangles, counter-clockwise seen from outside, with shared corners, coloured by height.
/// World frame, metres, +z up. Throws std::runtime_error with the path if the file cannot be written.
void write_ply_mesh(const OccupancyMap& map, const std::filesystem::path& file);

/// Writes the centres of the occupied cells as points into a binary PLY file, coloured by height. World frame,
/// metres. Throws as write_ply_mesh.
void write_ply_points(const OccupancyMap& map, const std::filesystem::path& file);

/// Writes a recorded run as time series for ParaView. There is one time step per plan and one for the last view;
/// the time is the number of the view. Files in `folder`, which must exist, with their parts in folders of the
/// same names:
/// - occupancy.pvd: grids, 0 unknown, 1 free, 2 occupied;
/// - frontiers.pvd: points;
/// - path.pvd: lines; `planned` is 1 for the path ahead and 0 for the path behind;
/// - field.pvd, if the planner has a field: points with `phi` and `downhill`.
///
/// Returns the three or four .pvd files. Throws std::runtime_error with the path of what cannot be read or
/// written.
std::vector<std::filesystem::path> write_paraview(const std::filesystem::path& record,
                                                  const std::filesystem::path& folder);

}  // namespace vantage
