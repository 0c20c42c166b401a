// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vector>

namespace vantage {

/// Parameters of a random building for field tests.
struct RoomsOptions {
  VoxelIndex extent{48, 48, 48};  ///< cells, including the closed outer walls
  std::int32_t room_cells = 16;   ///< distance between walls, cells
  std::int32_t door_cells = 4;    ///< edge of a door, cells
  std::int32_t wall_cells = 1;    ///< thickness of a wall, cells; 0: no walls
  double doors = 0.6;             ///< share of the walls between two rooms that have a door
  double clutter = 0.0002;        ///< boxes of up to 5 cells, per cell
  double unexplored = 0.3;        ///< unknown share of the diagonal
  std::uint32_t seed = 1;
};

/// A partly explored building of rooms with doors and clutter. Cells next to unknown space are sinks.
struct RandomRooms {
  std::vector<VoxelIndex> cells;  ///< free and known, in raster order, including other components
  std::vector<VoxelIndex> sinks;
  VoxelIndex source;  ///< a cell of the largest component, towards the low corner
  VoxelBox box;

  explicit RandomRooms(const RoomsOptions& options) : box{{0, 0, 0}, options.extent} {
    std::mt19937 engine(options.seed);
    VoxelGrid<std::uint8_t> state(box, kFree);
    build(state, options, engine);
    explore(state, options, engine);
    collect(state);
  }
  [[nodiscard]] LaplaceDomain domain() const {
    LaplaceDomain domain;
    for (const VoxelIndex& cell : cells) {
      domain.insert(cell);
    }
    for (const VoxelIndex& cell : sinks) {
      domain.insert_sink(cell);
    }
    return domain;
  }
  [[nodiscard]] LaplaceProblem problem() const { return LaplaceProblem(cells, sinks, source); }

 private:
  static constexpr std::uint8_t kFree = 0;
  static constexpr std::uint8_t kWall = 1;
  static constexpr std::uint8_t kUnknown = 2;
  using State = VoxelGrid<std::uint8_t>;

  static std::int32_t draw(std::mt19937& engine, std::int32_t from, std::int32_t to) {
    return to <= from ? from : std::uniform_int_distribution<std::int32_t>(from, to)(engine);
  }
  void fill(State& state, const VoxelBox& part, std::uint8_t value) const {
    const VoxelBox inside{
        {std::max(part.lo.x, 1), std::max(part.lo.y, 1), std::max(part.lo.z, 1)},
        {std::min(part.hi.x, box.hi.x - 1), std::min(part.hi.y, box.hi.y - 1), std::min(part.hi.z, box.hi.z - 1)}};
    for_each_cell(inside, [&](const VoxelIndex& cell) { state[cell] = value; });
  }
  void build(State& state, const RoomsOptions& o, std::mt19937& engine) const {
    const auto in_wall = [&](std::int32_t at) { return at % o.room_cells >= o.room_cells - o.wall_cells; };
    for_each_cell(box, [&](const VoxelIndex& c) {
      const bool shell =
          c.x == 0 || c.y == 0 || c.z == 0 || c.x == box.hi.x - 1 || c.y == box.hi.y - 1 || c.z == box.hi.z - 1;
      state[c] = shell || in_wall(c.x) || in_wall(c.y) || in_wall(c.z) ? kWall : kFree;
    });
    std::bernoulli_distribution has_door(o.doors);
    const std::int32_t inner = o.room_cells - o.wall_cells;
    for_each_cell(
        {{0, 0, 0}, {box.hi.x / o.room_cells + 1, box.hi.y / o.room_cells + 1, box.hi.z / o.room_cells + 1}},
        [&](const VoxelIndex& room) {
          const VoxelIndex corner{room.x * o.room_cells, room.y * o.room_cells, room.z * o.room_cells};
          for (int axis = 0; axis < 3; ++axis) {
            if (!has_door(engine)) {
              continue;
            }
            const auto along = [&](int which) {
              return which == axis ? inner : draw(engine, 1, inner - o.door_cells);
            };
            const auto size = [&](int which) { return which == axis ? o.wall_cells : o.door_cells; };
            const VoxelIndex lo = corner + VoxelIndex{along(0), along(1), along(2)};
            fill(state, {lo, lo + VoxelIndex{size(0), size(1), size(2)}}, kFree);
          }
        });
    const auto boxes = static_cast<std::int32_t>(o.clutter * static_cast<double>(box.size()));
    for (std::int32_t i = 0; i < boxes; ++i) {
      const VoxelIndex lo{draw(engine, 0, box.hi.x - 1), draw(engine, 0, box.hi.y - 1),
                          draw(engine, 0, box.hi.z - 1)};
      fill(state, {lo, lo + VoxelIndex{draw(engine, 1, 5), draw(engine, 1, 5), draw(engine, 1, 5)}}, kWall);
    }
  }
  // Unknown: the space beyond an inclined plane, and a ball.
  void explore(State& state, const RoomsOptions& o, std::mt19937& engine) const {
    const double longest = std::max({box.hi.x, box.hi.y, box.hi.z});
    const VoxelIndex centre{draw(engine, 0, box.hi.x - 1), draw(engine, 0, box.hi.y - 1),
                            draw(engine, 0, box.hi.z - 1)};
    for_each_cell(box, [&](const VoxelIndex& c) {
      const double along = 0.5 * c.x / box.hi.x + 0.3 * c.y / box.hi.y + 0.2 * c.z / box.hi.z;
      const VoxelIndex d = c - centre;
      const double distance =
          std::sqrt(static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y + static_cast<double>(d.z) * d.z);
      if (along > 1.0 - o.unexplored || distance < 0.08 * longest) {
        state[c] = kUnknown;
      }
    });
  }
  void collect(const State& state) {
    const auto is_sink = [&](const VoxelIndex& cell) {
      return std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                         [&](const VoxelIndex& step) { return state.value_or(cell + step, kWall) == kUnknown; });
    };
    for_each_cell(box, [&](const VoxelIndex& cell) {
      if (state[cell] == kFree) {
        cells.push_back(cell);
        if (is_sink(cell)) {
          sinks.push_back(cell);
        }
      }
    });
    std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
    for (const VoxelIndex& cell : largest_component(state)) {
      const VoxelIndex d = cell - VoxelIndex{box.hi.x / 4, box.hi.y / 4, box.hi.z / 4};
      const std::int64_t square = std::int64_t{d.x} * d.x + std::int64_t{d.y} * d.y + std::int64_t{d.z} * d.z;
      if (square < nearest && !is_sink(cell)) {
        nearest = square;
        source = cell;
      }
    }
  }
  [[nodiscard]] std::vector<VoxelIndex> largest_component(const State& state) const {
    VoxelGrid<std::uint8_t> seen(box, 0);
    std::vector<VoxelIndex> largest;
    for (const VoxelIndex& seed : cells) {
      std::vector<VoxelIndex> queue;
      if (std::exchange(seen[seed], std::uint8_t{1}) == 0) {
        queue.push_back(seed);
      }
      for (std::size_t next = 0; next < queue.size(); ++next) {
        for (const VoxelIndex& step : kFaceNeighbours) {
          const VoxelIndex cell = queue[next] + step;
          if (state.value_or(cell, kWall) == kFree && std::exchange(seen[cell], std::uint8_t{1}) == 0) {
            queue.push_back(cell);
          }
        }
      }
      if (queue.size() > largest.size()) {
        largest = std::move(queue);
      }
    }
    return largest;
  }
};

}  // namespace vantage
