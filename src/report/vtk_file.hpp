// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// A named array of a VTK file as an XML element: binary, packed by deflate.
[[nodiscard]] std::string vtk_array(std::string_view name, const std::vector<float>& values, int components = 1);
[[nodiscard]] std::string vtk_array(std::string_view name, const std::vector<std::uint8_t>& values);
[[nodiscard]] std::string vtk_array(std::string_view name, const std::vector<std::int32_t>& values);

/// Writes a grid (.vti) with one value per cell of `cells`, x fastest.
void write_vti(const VoxelBox& cells, const VoxelFrame& frame, std::string_view name,
               const std::vector<std::uint8_t>& values, const std::filesystem::path& file);

/// Points and lines through them (.vtp). Without lines every point is a vertex of its own. `point_arrays` and
/// `line_arrays` are made by vtk_array.
struct VtkPolyData {
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::int32_t> line_lengths = {};  ///< number of points of each line, in order
  std::string point_arrays = {};
  std::string line_arrays = {};
};
void write_vtp(const VtkPolyData& data, const std::filesystem::path& file);

/// Writes a time series (.pvd) of files with their times. Paths are relative to the folder of `file`.
void write_pvd(const std::vector<std::pair<std::size_t, std::filesystem::path>>& parts,
               const std::filesystem::path& file);

}  // namespace vantage::detail
