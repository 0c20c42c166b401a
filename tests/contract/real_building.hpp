// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

#include "contract/cell_drawing.hpp"
#include "contract/changing_world.hpp"
#include "support/real_data.hpp"

namespace vantage::testing {

/// A random window of a real building, closed at its border, in which a body of this radius (cells) has room to move:
/// one layer of cells if the world is a plane, else a space: the first of 20 with room in a twentieth of its cells,
/// or the one with the most. `start` is a random place where the body fits. The same for the same seed. Throws
/// std::runtime_error if the body fits nowhere.
[[nodiscard]] inline ChangingWorld window_of(const World& world, std::uint32_t seed, double cell_m,
                                             double body_cells) {
  const bool flat = world.plan.has_value();
  const VoxelIndex extent = flat ? VoxelIndex{48, 36, 1} : VoxelIndex{30, 22, 9};
  const VoxelFrame frame{cell_m};
  const VoxelBox all = frame.cells_touched_by(world.region);
  const auto reach = static_cast<std::int32_t>(std::ceil(body_cells));
  WholeNumbers draw(seed);
  const auto first = [&](std::int32_t lo, std::int32_t hi, std::int32_t length) {
    return hi - lo > length ? draw(lo, hi - length) : lo;
  };
  ChangingWorld best;
  std::size_t most_places = 0;
  for (int attempt = 0; attempt < 20; ++attempt) {
    const VoxelIndex lo{first(all.lo.x, all.hi.x, extent.x), first(all.lo.y, all.hi.y, extent.y),
                        flat ? 0 : first(all.lo.z, all.hi.z, extent.z)};
    const Truth truth(world, cell_m, frame.box_of(VoxelBox{lo, lo + extent}), 0.0);
    ChangingWorld window;
    window.frame = frame;
    window.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, extent}, 0);
    window.sheets = VoxelGrid<std::uint8_t>(window.solid.box(), 0);
    for_each_cell(window.solid.box(), [&](const VoxelIndex& cell) {
      window.solid[cell] = truth.at(lo + cell) == CellTruth::Free ? 0 : 1;
    });
    close_border(window.solid);
    std::vector<VoxelIndex> places;
    for_each_cell(window.solid.box(), [&](const VoxelIndex& cell) {
      bool fits = true;
      for_each_cell(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(reach), [&](const VoxelIndex& touched) {
        fits = fits && ((flat && touched.z != 0) || !window.is_solid(touched));
      });
      if (fits) {
        places.push_back(cell);
      }
    });
    if (places.size() > most_places) {
      most_places = places.size();
      window.start = places[static_cast<std::size_t>(draw(0, static_cast<std::int32_t>(places.size()) - 1))];
      best = window;
    }
    if (most_places * 20 > window.solid.size()) {
      break;
    }
  }
  if (most_places == 0) {
    throw std::runtime_error(world.name + ": no window has room for a body of " + std::to_string(body_cells) +
                             " cells");
  }
  return best;
}

inline constexpr std::uint32_t kSeedsOfABuilding = 11;

/// One of the buildings below VANTAGE_DATA, the same for so many seeds in a row: floor plans, worlds of aerial
/// exploration, houses and offices with furniture.
[[nodiscard]] inline const World& real_building(std::uint32_t seed) {
  static const std::vector<World> all = [] {
    std::vector<World> worlds;
    for (const char* file : {"floorplans/kth/50052748.yaml", "environments/aerial/complex_office.stl",
                             "floorplans/kth/50052750.yaml", "environments/aws_small_house/small_house_collision.ply",
                             "floorplans/kth/50015847.yaml", "environments/gazebo/collapsed_house.ply",
                             "environments/aerial/maze1.obj", "environments/gazebo/osrf_first_office.ply"}) {
      worlds.push_back(World::from_file(test::real_data(file)));
      worlds.back().name = file;
    }
    return worlds;
  }();
  return all[seed / kSeedsOfABuilding % all.size()];
}

}  // namespace vantage::testing
