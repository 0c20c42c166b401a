// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/report/map_export.hpp>
#include <vector>

#include <vantage/map/impl/plain_stream.hpp>
#include <vantage/map/impl/whole_file.hpp>
#include "report/bytes.hpp"

namespace vantage {
namespace {

using Colour = std::array<std::uint8_t, 3>;

// Colour of a height in [0, 1]: from deep blue (low) to pale yellow (high).
Colour colour_of(double share) {
  constexpr std::array<std::array<double, 3>, 5> kStops{
      {{43, 58, 103}, {63, 95, 138}, {91, 138, 154}, {207, 208, 164}, {255, 247, 234}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const double value = kStops[low][i] + (at - static_cast<double>(low)) * (kStops[low + 1][i] - kStops[low][i]);
    colour[i] = static_cast<std::uint8_t>(std::lround(value));
  }
  return colour;
}

// Corners of the face of cell (0, 0, 0) towards each of kFaceNeighbours, counter-clockwise seen from outside.
constexpr std::array<std::array<VoxelIndex, 4>, 6> kCorners{{
    {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}},
    {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}},
    {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}},
    {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}},
    {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}},
    {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
}};

std::vector<VoxelIndex> occupied_cells(const OccupancyMap& map) {
  std::vector<VoxelIndex> cells;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    if (state == Occupancy::Occupied) {
      cells.push_back(cell);
    }
  });
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  return cells;
}

// Writes a PLY file of coloured vertices and, if there are any, triangles.
void write_ply(const std::vector<Eigen::Vector3d>& vertices,
               const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::filesystem::path& file) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Eigen::Vector3d& vertex : vertices) {
    low = std::min(low, vertex.z());
    high = std::max(high, vertex.z());
  }
  detail::ByteWriter body;
  for (const Eigen::Vector3d& vertex : vertices) {
    for (const double value : {vertex.x(), vertex.y(), vertex.z()}) {
      body.small_real(static_cast<float>(value));
    }
    for (const std::uint8_t value : colour_of(high > low ? (vertex.z() - low) / (high - low) : 0.5)) {
      body.byte(value);
    }
  }
  for (const std::array<std::uint32_t, 3>& triangle : triangles) {
    body.byte(3);
    for (const std::uint32_t corner : triangle) {
      body.word(corner, 4);
    }
  }
  detail::PlainStream out;
  out << "ply\nformat binary_little_endian 1.0\ncomment metres, z up\nelement vertex " << vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!triangles.empty()) {
    out << "element face " << triangles.size() << "\nproperty list uchar uint vertex_indices\n";
  }
  out << "end_header\n" << body.bytes();
  detail::write_whole_file(file, out.str());
}

}  // namespace

void write_ply_mesh(const OccupancyMap& map, const std::filesystem::path& file) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::unordered_map<VoxelIndex, std::uint32_t> numbers;  // vertex number by the cell whose lowest corner it is
  const auto vertex = [&](const VoxelIndex& corner) {
    const auto [at, is_new] = numbers.try_emplace(corner, static_cast<std::uint32_t>(vertices.size()));
    if (is_new) {
      vertices.push_back(map.frame().corner_of(corner));
    }
    return at->second;
  };
  for (const VoxelIndex& cell : occupied_cells(map)) {
    for (std::size_t direction = 0; direction < kCorners.size(); ++direction) {
      if (map.at(cell + kFaceNeighbours[direction]) != Occupancy::Occupied) {
        std::array<std::uint32_t, 4> corners{};
        std::transform(kCorners[direction].begin(), kCorners[direction].end(), corners.begin(),
                       [&](const VoxelIndex& corner) { return vertex(cell + corner); });
        triangles.push_back({corners[0], corners[1], corners[2]});
        triangles.push_back({corners[0], corners[2], corners[3]});
      }
    }
  }
  write_ply(vertices, triangles, file);
}

void write_ply_points(const OccupancyMap& map, const std::filesystem::path& file) {
  std::vector<Eigen::Vector3d> points;
  for (const VoxelIndex& cell : occupied_cells(map)) {
    points.push_back(map.frame().centre_of(cell));
  }
  write_ply(points, {}, file);
}

}  // namespace vantage
