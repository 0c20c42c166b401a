// SPDX-License-Identifier: MIT
// Checks that VoxelRay, compiled with this file's flags, visits the same cells as the library. Rays connect cell
// centres, so many pass exactly through edges. In a map, only the cells of one ray are free; the library's ray
// reaches its end only if it stays in them, and all paths between two cells have the same length.
#include <cstdint>
#include <iostream>
#include <random>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/ray_caster.hpp>

int main() {
  constexpr int kRays = 20000;
  std::mt19937 engine(20240617);
  const auto cell = [&engine] {
    const auto coordinate = [&engine] { return static_cast<std::int32_t>(engine() % 17U) - 8; };
    const std::int32_t x = coordinate();
    const std::int32_t y = coordinate();
    return vantage::VoxelIndex{x, y, coordinate()};
  };
  int different = 0;
  std::int64_t cells = 0;
  for (int ray = 0; ray < kRays; ++ray) {
    vantage::OccupancyMap map({.resolution_m = 0.1});
    const Eigen::Vector3d from = map.frame().centre_of(cell());
    const vantage::VoxelIndex last = cell();
    const Eigen::Vector3d to = map.frame().centre_of(last);
    for (const vantage::VoxelIndex& passed : vantage::VoxelRay(map.frame(), from, to)) {
      map.set(passed, vantage::Occupancy::Free);
      ++cells;
    }
    const vantage::RayEnd end = vantage::RayCaster(map).cast(from, to);
    different += end.cell == last && end.occupancy == vantage::Occupancy::Free ? 0 : 1;
  }
  std::cout << different << " of " << kRays << " rays (" << cells << " cells) visit other cells than the library's\n";
  return different == 0 && cells > 10 * kRays ? 0 : 1;
}
