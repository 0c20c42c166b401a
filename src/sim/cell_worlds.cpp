// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vantage/sim/triangle_mesh.hpp>
#include <vector>

#include "sim/cell_worlds.hpp"

namespace vantage {
namespace {

constexpr double kInsetM = 0.01;

void fill(SolidCells& solid, const VoxelIndex& lo, const VoxelIndex& hi, bool value = true) {
  for_each_cell({lo, hi}, [&](const VoxelIndex& cell) { solid[cell] = value ? 1 : 0; });
}

void carve(SolidCells& solid, const VoxelIndex& lo, const VoxelIndex& hi) { fill(solid, lo, hi, false); }

// A hall of this many cells. Its walls, floor and ceiling are one cell thick.
SolidCells hall(const VoxelIndex& extent) {
  SolidCells solid({{0, 0, 0}, extent}, 1);
  carve(solid, {1, 1, 1}, extent - VoxelIndex{1, 1, 1});
  return solid;
}

// Not std::uniform_int_distribution, because its numbers differ between standard libraries.
class WorldDice {
 public:
  explicit WorldDice(std::uint64_t seed) : engine_(seed) {}
  // A random integer in [lo, hi].
  std::int32_t between(std::int32_t lo, std::int32_t hi) {
    const auto sides = static_cast<std::uint64_t>(std::max(hi - lo, 0)) + 1;
    return lo + static_cast<std::int32_t>(engine_() % sides);
  }

 private:
  std::mt19937_64 engine_;
};

std::int32_t cells_of(double metres, double own_m) {
  return static_cast<std::int32_t>(std::lround((metres > 0.0 ? metres : own_m) / kWorldCellM));
}

constexpr std::int32_t kDoorHeight = 10;  // 2 m above the floor
constexpr std::int32_t kDoorWidth = 6;    // 1.2 m

// Splits the cells along x from `x0` to `x1` into rooms, each at least 3 m wide where there is space.
std::vector<std::pair<std::int32_t, std::int32_t>> split_rooms(WorldDice& dice, std::int32_t x0, std::int32_t x1) {
  std::vector<std::pair<std::int32_t, std::int32_t>> rooms;
  while (x1 - x0 > 40) {
    const std::int32_t wall = x0 + dice.between(16, 26);
    rooms.emplace_back(x0, wall);
    x0 = wall + 1;
  }
  rooms.emplace_back(x0, x1);
  return rooms;
}

// Puts tables and cupboards on the floor, clear of the path from the door.
void furnish(SolidCells& solid, WorldDice& dice, const VoxelIndex& lo, const VoxelIndex& hi) {
  for (std::int32_t piece = dice.between(1, 3); piece > 0; --piece) {
    const VoxelIndex size{dice.between(3, 8), dice.between(2, 4), dice.between(2, 9)};
    if (hi.x - lo.x <= size.x + 8 || hi.y - lo.y <= size.y) {
      continue;
    }
    const bool left = dice.between(0, 1) == 0;
    const VoxelIndex at{left ? lo.x : hi.x - size.x, dice.between(lo.y, hi.y - size.y), lo.z};
    fill(solid, at, at + size);
  }
}

struct RoomRow {
  std::int32_t near;  // the wall to the corridor
  std::int32_t lo;    // cells of the rooms along y
  std::int32_t hi;
};

void add_room_row(SolidCells& solid, WorldDice& dice, const RoomRow& row, std::int32_t length, std::int32_t height) {
  fill(solid, {1, row.near, 1}, {length - 1, row.near + 1, height - 1});
  for (const auto& [x0, x1] : split_rooms(dice, 1, length - 1)) {
    if (x1 < length - 1) {
      fill(solid, {x1, row.lo, 1}, {x1 + 1, row.hi, height - 1});
    }
    const std::int32_t door = x0 + dice.between(1, std::max(1, x1 - x0 - kDoorWidth - 1));
    furnish(solid, dice, {x0, row.lo + 4, 1}, {x1, row.hi - 4, height - 1});
    carve(solid, {door, row.near, 1}, {std::min(door + kDoorWidth, x1), row.near + 1, 1 + kDoorHeight});
  }
}

}  // namespace

World world_of_cells(std::string name, const SolidCells& solid) {
  const VoxelFrame frame{kWorldCellM};
  World world;
  world.name = std::move(name);
  world.mesh = surface_of_cells(solid, frame, kInsetM);
  world.region = frame.box_of(solid.box());
  return world;
}

// Three rooms below, two above. Every opening is 1.8 m wide.
SolidCells rooms_cells() {
  constexpr std::int32_t kEdge = 51;
  constexpr std::int32_t kLast = kEdge - 1;
  constexpr std::int32_t kSlab = 25;
  SolidCells solid = hall({kEdge, kEdge, kEdge});
  fill(solid, {1, 1, kSlab}, {kLast, kLast, kSlab + 1});
  fill(solid, {20, 1, 1}, {21, kLast, kSlab});
  fill(solid, {21, 28, 1}, {kLast, 29, kSlab});
  fill(solid, {1, 30, kSlab + 1}, {kLast, 31, kLast});
  carve(solid, {20, 8, 1}, {21, 17, 10});
  carve(solid, {36, 28, 1}, {45, 29, 10});
  carve(solid, {20, 36, 12}, {21, 45, 21});
  carve(solid, {6, 6, kSlab}, {15, 15, kSlab + 1});
  carve(solid, {30, 38, kSlab}, {39, 47, kSlab + 1});
  carve(solid, {20, 30, 33}, {29, 31, 42});
  return solid;
}

SolidCells office_cells(const WorldOptions& options) {
  const std::int32_t length = cells_of(options.length_m, 20.0);
  const std::int32_t width = cells_of(options.width_m, 14.0);
  constexpr std::int32_t kHeight = 15;
  constexpr std::int32_t kCorridor = 9;
  WorldDice dice(options.seed);
  SolidCells solid = hall({length, width, kHeight});
  const std::int32_t corridor = std::max(2, (width - kCorridor) / 2 + dice.between(-2, 2));
  const std::int32_t end = corridor + kCorridor;
  if (corridor > 8) {
    add_room_row(solid, dice, {corridor - 1, 1, corridor - 1}, length, kHeight);
  }
  if (width - end > 8) {
    add_room_row(solid, dice, {end, end + 1, width - 1}, length, kHeight);
  }
  return solid;
}

// Depth-first passages (recursive backtracker), then one closed wall in ten is opened, so that there are loops.
SolidCells maze_cells(const WorldOptions& options) {
  constexpr std::int32_t kPitch = 8;
  constexpr std::int32_t kHeight = 12;
  const std::int32_t columns = (cells_of(options.length_m, 13.0) - 1) / kPitch;
  const std::int32_t rows = (cells_of(options.width_m, 10.0) - 1) / kPitch;
  WorldDice dice(options.seed);
  SolidCells solid({{0, 0, 0}, {columns * kPitch + 1, rows * kPitch + 1, kHeight}}, 1);
  const auto hollow = [&](std::int32_t x, std::int32_t y) {
    carve(solid, {x * kPitch + 1, y * kPitch + 1, 1}, {(x + 1) * kPitch, (y + 1) * kPitch, kHeight - 1});
  };
  const auto open = [&](std::int32_t x, std::int32_t y, bool along_x) {
    const VoxelIndex lo =
        along_x ? VoxelIndex{(x + 1) * kPitch, y * kPitch + 1, 1} : VoxelIndex{x * kPitch + 1, (y + 1) * kPitch, 1};
    carve(solid, lo,
          lo + (along_x ? VoxelIndex{1, kPitch - 1, kHeight - 2} : VoxelIndex{kPitch - 1, 1, kHeight - 2}));
  };
  std::vector<std::uint8_t> visited(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  const auto place = [&](std::int32_t x, std::int32_t y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  };
  std::vector<std::pair<std::int32_t, std::int32_t>> trail{{0, 0}};
  visited[0] = 1;
  hollow(0, 0);
  while (!trail.empty()) {
    const auto [x, y] = trail.back();
    std::vector<std::pair<std::int32_t, std::int32_t>> next;
    for (const auto& [dx, dy] :
         std::array<std::pair<std::int32_t, std::int32_t>, 4>{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}}) {
      const bool inside = x + dx >= 0 && x + dx < columns && y + dy >= 0 && y + dy < rows;
      if (inside && visited[place(x + dx, y + dy)] == 0) {
        next.emplace_back(x + dx, y + dy);
      }
    }
    if (next.empty()) {
      trail.pop_back();
      continue;
    }
    const auto [nx, ny] = next[static_cast<std::size_t>(dice.between(0, static_cast<std::int32_t>(next.size()) - 1))];
    visited[place(nx, ny)] = 1;
    hollow(nx, ny);
    open(std::min(x, nx), std::min(y, ny), nx != x);
    trail.emplace_back(nx, ny);
  }
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < columns; ++x) {
      if (x + 1 < columns && dice.between(0, 9) == 0) {
        open(x, y, true);
      }
      if (y + 1 < rows && dice.between(0, 9) == 0) {
        open(x, y, false);
      }
    }
  }
  return solid;
}

SolidCells two_storey_cells() {
  const VoxelIndex extent{60, 45, 29};
  constexpr std::int32_t kSlab = 14;
  SolidCells solid = hall(extent);
  fill(solid, {1, 1, kSlab}, {extent.x - 1, extent.y - 1, kSlab + 1});
  carve(solid, {22, 1, kSlab}, {38, 11, kSlab + 1});  // the stairwell
  for (std::int32_t step = 0; step < kSlab; ++step) {
    fill(solid, {23 + step, 1, 1}, {24 + step, 5, 1 + step});
  }
  for (const std::int32_t floor : {1, kSlab + 1}) {
    const std::int32_t ceiling = floor == 1 ? kSlab : extent.z - 1;
    const bool lower = floor == 1;
    const std::int32_t across = lower ? 20 : 40;
    fill(solid, {across, 1, floor}, {across + 1, extent.y - 1, ceiling});
    fill(solid, {1, 24, floor}, {extent.x - 1, 25, ceiling});
    carve(solid, {across, 12, floor}, {across + 1, 18, floor + kDoorHeight});
    carve(solid, {across, 32, floor}, {across + 1, 38, floor + kDoorHeight});
    carve(solid, {lower ? 44 : 8, 24, floor}, {lower ? 50 : 14, 25, floor + kDoorHeight});
    fill(solid, {4, 30, floor}, {12, 34, floor + 4});
    fill(solid, {50, 36, floor}, {56, 42, floor + 3});
    fill(solid, {lower ? 6 : 50, 6, floor}, {lower ? 14 : 57, 10, floor + 4});
  }
  return solid;
}

}  // namespace vantage
