// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/scan.hpp>
#include <vantage/raytrace/range_sensor.hpp>

#include "contract/cell_drawing.hpp"

namespace vantage::testing {

enum class Building : std::uint8_t {
  Rooms,   // one-cell walls with open doorways
  Sheets,  // the same rooms with walls of zero thickness between cells
  Grille,  // a wall of bars: transparent to rays, closed to the body
  Doors,   // doors that close and open
  Walker,  // a person who walks to and fro
};
inline constexpr std::size_t kBuildings = 5;

/// A small building of cells, in 3D or in one layer, in which objects may move while a robot explores it.
struct ChangingWorld {
  VoxelFrame frame{0.2};
  VoxelGrid<std::uint8_t> solid;
  VoxelGrid<std::uint8_t> sheets;  // bit a: a wall of zero thickness on the upper face of axis a
  VoxelBox doorway{};              // between the room of the start and the others
  VoxelBox door{};                 // empty: no moving door
  std::optional<VoxelBox> person;
  double inset = 0.0;  // how deep surfaces lie in their cells, cells
  VoxelIndex start{3, 3, 3};
  std::size_t clock = 0;

  [[nodiscard]] bool is_flat() const { return solid.box().extent().z == 1; }
  [[nodiscard]] bool is_static() const { return door.empty() && !person; }
  [[nodiscard]] bool door_is_closed() const { return clock % 24 >= 3 && clock % 24 < 15; }
  [[nodiscard]] bool is_solid(const VoxelIndex& cell) const {
    return solid.value_or(cell, 1) != 0 || (door.contains(cell) && door_is_closed()) ||
           (person && person->contains(cell));
  }
  /// What fills a solid cell.
  [[nodiscard]] Box filled(const VoxelIndex& cell) const {
    Box box = frame.box_of(cell);
    for (const VoxelIndex& step : kFaceNeighbours) {
      if (is_solid(cell) && !is_solid(cell + step)) {
        const Eigen::Vector3d out = inset * frame.size_m * Eigen::Vector3d(step.x, step.y, step.z);
        box.min -= out.cwiseMin(0.0);
        box.max -= out.cwiseMax(0.0);
      }
    }
    return box;
  }
  /// Whether a wall separates two face neighbours.
  [[nodiscard]] bool parted(const VoxelIndex& a, const VoxelIndex& b) const {
    const VoxelIndex step = b - a;
    const int axis = step.x != 0 ? 0 : step.y != 0 ? 1 : 2;
    const VoxelIndex lower = step.x + step.y + step.z > 0 ? a : b;
    return (sheets.value_or(lower, 0) >> axis & 1) != 0;
  }
  [[nodiscard]] bool has_sheet(const VoxelIndex& cell) const {
    return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                       [&](const VoxelIndex& step) { return parted(cell, cell + step); });
  }
  /// Whether the centre of `cell` is in clear line of sight from `origin`.
  [[nodiscard]] bool in_sight(const Eigen::Vector3d& origin, const VoxelIndex& cell) const {
    VoxelIndex last = frame.cell_of(origin);
    for (const VoxelIndex& next : VoxelRay(frame, origin, frame.centre_of(cell))) {
      if ((next != last && parted(last, next)) || (next != cell && is_solid(next))) {
        return false;
      }
      last = next;
    }
    return true;
  }
  /// Advances the moving objects by one step. Nothing moves into the robot.
  void tick(const Eigen::Vector3d& robot) {
    const VoxelIndex at = frame.cell_of(robot);
    const auto is_near = [&](const VoxelBox& box) { return box.grown(3).contains(at); };
    if (!(is_near(door) && !door_is_closed())) {
      ++clock;
    }
    if (person) {
      const std::int32_t step = clock / 8 % 2 == 0 ? -1 : 1;
      for (const std::int32_t by : {step, -step}) {  // who meets the robot turns round
        const VoxelBox next{person->lo + VoxelIndex{by, 0, 0}, person->hi + VoxelIndex{by, 0, 0}};
        const bool moves_away = by > 0 ? at.x < person->lo.x : at.x >= person->hi.x;
        bool has_room = moves_away || !is_near(next);
        for_each_cell(next, [&](const VoxelIndex& cell) { has_room = has_room && solid.value_or(cell, 1) == 0; });
        if (has_room) {
          person = next;
          break;
        }
      }
    }
  }
};

[[nodiscard]] inline ChangingWorld make_changing_world(Building building, std::uint32_t seed, double cell_m,
                                                       bool flat) {
  constexpr std::int32_t kX = 21;
  constexpr std::int32_t kY = 15;
  const std::int32_t top = flat ? 1 : 8;
  ChangingWorld world;
  world.frame = VoxelFrame{cell_m};
  world.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {kX, kY, top}}, 0);
  world.sheets = VoxelGrid<std::uint8_t>(world.solid.box(), 0);
  world.start.z = flat ? 0 : 3;
  WholeNumbers draw(seed);
  const auto fill = [&](const VoxelBox& box, std::uint8_t value) { fill_cells(world.solid, box, value); };
  const bool thin = building == Building::Sheets;
  const auto wall = [&](const VoxelBox& box, std::uint8_t axis, bool stands) {
    if (!thin) {
      fill(box, stands ? 1 : 0);
      return;
    }
    fill_cells(world.sheets, box, static_cast<std::uint8_t>(stands ? 1U << axis : 0U));
  };
  const std::int32_t head = flat ? 1 : 6;
  const std::int32_t across = draw(7, 10);
  const std::int32_t gap = draw(2, 10);
  const VoxelBox doorway{{across, gap, flat ? 0 : 1}, {across + 1, gap + 3, head}};
  world.doorway = doorway;
  wall({{across, 0, 0}, {across + 1, kY, top}}, 0, true);
  if (building == Building::Grille) {
    for (std::int32_t y = 2; y < kY - 1; y += 2) {
      fill({{across, y, flat ? 0 : 1}, {across + 1, y + 1, head}}, 0);
    }
  } else {
    wall(doorway, 0, false);
  }
  const std::int32_t cross = draw(6, 8);
  wall({{across + 1, cross, 0}, {kX, cross + 1, top}}, 1, true);
  wall({{across + 4, cross, flat ? 0 : 1}, {across + 7, cross + 1, head}}, 1, false);
  for (int i = 0; i < 3; ++i) {
    const VoxelIndex lo{draw(across + 3, 18), draw(1, 12), flat ? 0 : draw(1, 5)};
    if (lo.y < cross - 2 || lo.y > cross + 3) {
      fill({lo, lo + VoxelIndex{1, 1, draw(1, 2)}}, 1);
    }
  }
  close_border(world.solid);
  if (building == Building::Doors) {
    world.door = doorway;
  }
  if (building == Building::Walker) {
    world.person = VoxelBox{{across + 5, 2, flat ? 0 : 1}, {across + 7, 4, flat ? 1 : 5}};
    fill({{across + 2, 2, flat ? 0 : 1}, {kX - 1, 4, flat ? 1 : 5}}, 0);
  }
  return world;
}

/// A simulated scan: each ray returns a point just inside what fills the first solid cell, or just behind the first
/// wall of zero thickness. A ray that only cuts a corner of a cell passes: its point would lie in the cell beyond.
[[nodiscard]] inline Scan scan_of(const ChangingWorld& world, const RangeSensor& sensor, const Pose& pose) {
  Scan scan;
  scan.world_from_sensor = pose;
  scan.max_range_m = sensor.max_range_m;
  const Eigen::Vector3d origin = pose.translation();
  const double far_m = 40.0 * world.frame.size_m;
  for (const Eigen::Vector3f& direction : sensor.directions()) {
    const Eigen::Vector3d ray = pose.linear() * direction.cast<double>();
    VoxelIndex last = world.frame.cell_of(origin);
    for (const VoxelIndex& cell : VoxelRay(world.frame, origin, origin + far_m * ray)) {
      const bool blocked = world.is_solid(cell) || (cell != last && world.parted(last, cell));
      last = cell;
      if (!blocked) {
        continue;
      }
      const Box filled = world.filled(cell);
      const double range_m = range_into(filled, origin, ray);
      const Eigen::Vector3d point = origin + range_m * ray;
      if (world.frame.cell_of(point) == cell && filled.contains(point)) {
        add_ray(scan, sensor, direction, range_m);
        break;
      }
    }
  }
  return scan;
}

}  // namespace vantage::testing
