// SPDX-License-Identifier: MIT
#include "sim/sight.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace vantage {
namespace {

// Rooms with openings and single solid cells, so that cells are occluded at all distances.
TrueCells drawn_cells(std::mt19937_64& engine, const VoxelBox& box) {
  VoxelGrid<CellTruth> cells(box, CellTruth::Free);
  const auto below = [&](std::int32_t n) {
    return static_cast<std::int32_t>(engine() % static_cast<std::uint64_t>(n));
  };
  for_each_cell(box, [&](const VoxelIndex& cell) {
    const bool border = !VoxelBox{box.lo + VoxelIndex{1, 1, 1}, box.hi - VoxelIndex{1, 1, 1}}.contains(cell);
    cells[cell] = border && box.extent().z > 1 ? CellTruth::Occupied : CellTruth::Free;
  });
  for (int wall = 0; wall < 6; ++wall) {
    const int axis = below(box.extent().z > 1 ? 3 : 2);
    const std::int32_t at = (axis == 0   ? box.lo.x + below(box.extent().x)
                             : axis == 1 ? box.lo.y + below(box.extent().y)
                                         : box.lo.z + below(box.extent().z));
    const VoxelIndex gap = box.lo + VoxelIndex{below(box.extent().x), below(box.extent().y), below(box.extent().z)};
    for_each_cell(box, [&](const VoxelIndex& cell) {
      const std::int32_t along = axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z;
      const VoxelIndex off = cell - gap;
      const bool open = std::abs(off.x) <= 1 + 99 * (axis == 0) && std::abs(off.y) <= 1 + 99 * (axis == 1) &&
                        std::abs(off.z) <= 1 + 99 * (axis == 2);
      if (along == at && !open) {
        cells[cell] = CellTruth::Occupied;
      }
    });
  }
  for (std::size_t speck = 0; speck < cells.size() / 20; ++speck) {
    cells.values()[engine() % cells.size()] = engine() % 2 == 0 ? CellTruth::Occupied : CellTruth::Grazed;
  }
  TrueCells drawn(box);
  for_each_cell(box, [&](const VoxelIndex& cell) { drawn.set(cell, cells[cell]); });
  return drawn;
}

// By definition: tests every cell with every pose, including cells behind solid ones.
TEST(SeenCells, AreThoseThatAnyOfThePosesSees) {
  std::mt19937_64 engine(5);
  std::size_t seen = 0;
  std::size_t hidden = 0;
  std::size_t told = 0;
  std::size_t seen_in_part = 0;
  for (int world = 0; world < 60; ++world) {
    const VoxelBox box{{-13, 4, -6}, {17, 30, world % 3 == 0 ? -5 : 6}};
    const TrueCells cells = drawn_cells(engine, box);
    const VoxelGrid<std::uint8_t> all(box);
    std::vector<VoxelIndex> poses;
    const std::size_t many = world % 2 == 0 ? 5 : 60;
    for (std::size_t i = 0; i < many; ++i) {
      if (const VoxelIndex cell = all.cell_at(engine() % all.size()); cells[cell] == CellTruth::Free) {
        poses.push_back(cell);
      }
    }
    RangeSensor sensor =
        RangeSensor::pinhole(64, 48, 1.0, 0.7, world % 5 == 0 ? 0.6 : 0.0, world % 4 == 0 ? 9.0 : 2.1);
    sensor.reports_no_return = world % 7 != 0;
    const Sight sight(cells, {0.1}, sensor, world % 6 != 0);
    // Every other world: only the cells of a smaller box, most poses outside of it.
    const VoxelBox part{{-4, 11, box.lo.z}, {9, 22, std::min(box.hi.z, 3)}};
    const VoxelBox& region = world / 2 % 2 == 0 ? box : part;
    std::vector<VoxelIndex> expected;
    for_each_cell(region, [&](const VoxelIndex& cell) {
      const bool is_seen =
          std::any_of(poses.begin(), poses.end(), [&](const VoxelIndex& pose) { return sight.sees(pose, cell); });
      if (is_seen) {
        expected.push_back(cell);
      }
      ++(is_seen ? seen : hidden);
      seen_in_part += is_seen && &region == &part ? 1U : 0U;
    });
    double last_share = 0.0;
    const auto on_share = [&](double share) {
      EXPECT_GT(share, last_share);
      last_share = share;
      ++told;
    };
    EXPECT_EQ(seen_cells(sight, region, poses, 1 + world % 3, on_share), expected) << "in world " << world;
    EXPECT_EQ(last_share, poses.empty() ? 0.0 : 1.0);
  }
  EXPECT_GT(seen, 25'000U);
  EXPECT_GT(hidden, 25'000U);
  EXPECT_GT(seen_in_part, 5'000U);
  EXPECT_GT(told, 100U);
}

// By definition, in planes from nearly empty to cluttered, with poses on a lattice: lines pass many edges and
// corners.
TEST(SeenCells, OfAPlaneAreThoseThatAnyOfThePosesSees) {
  std::mt19937_64 engine(6);
  std::size_t seen = 0;
  std::size_t hidden = 0;
  for (int world = 0; world < 80; ++world) {
    const VoxelBox box{{-20, -9, 3}, {17, 25, 4}};
    TrueCells cells = world % 2 == 0 ? drawn_cells(engine, box) : TrueCells(box);
    const std::uint64_t one_in = 2 + engine() % 60;
    for_each_cell(box, [&](const VoxelIndex& cell) {
      if (engine() % one_in == 0) {
        cells.set(cell, CellTruth::Occupied);
      }
    });
    const std::int32_t pitch = 1 + world % 5;
    std::vector<VoxelIndex> poses;
    for_each_cell(box, [&](const VoxelIndex& cell) {
      const bool on_lattice = cell.x % pitch == 0 && cell.y % pitch == 0 && cell.x < 10;
      if (on_lattice && cells[cell] == CellTruth::Free && engine() % 8 == 0) {
        poses.push_back(cell);
      }
    });
    RangeSensor sensor = RangeSensor::pinhole(64, 48, 1.0, 0.7, 0.0, world % 4 == 0 ? 9.0 : 1.3);
    sensor.reports_no_return = world % 7 != 0;
    const Sight sight(cells, {0.1}, sensor, true);
    std::vector<VoxelIndex> expected;
    for_each_cell(box, [&](const VoxelIndex& cell) {
      if (std::any_of(poses.begin(), poses.end(), [&](const VoxelIndex& pose) { return sight.sees(pose, cell); })) {
        expected.push_back(cell);
      }
    });
    EXPECT_EQ(seen_cells(sight, box, poses, 1), expected) << "in world " << world;
    seen += expected.size();
    hidden += box.size() - expected.size();
  }
  EXPECT_GT(seen, 30'000U);
  EXPECT_GT(hidden, 15'000U);
}

}  // namespace
}  // namespace vantage
