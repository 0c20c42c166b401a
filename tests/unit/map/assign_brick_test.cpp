// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include "support/changing_map.hpp"
#include "support/equal_maps.hpp"

namespace vantage {
namespace {

struct Planes {
  BrickPlane known{};
  BrickPlane occupied{};
};

// None, all, few, half or most cells known; all may be free.
Planes random_planes(std::mt19937& engine) {
  const auto word = [&] { return std::uint64_t{engine()} << 32U | engine(); };
  Planes planes;
  const std::size_t kind = engine() % 6;
  const bool free = engine() % 2 == 0;
  for (std::size_t i = 0; i < Brick::kWords; ++i) {
    const std::uint64_t a = word();
    const std::uint64_t b = word();
    planes.known[i] = kind == 0   ? 0
                      : kind == 1 ? ~std::uint64_t{0}
                      : kind == 2 ? a & b & word()
                      : kind == 3 ? a
                                  : a | b;
    planes.occupied[i] = kind == 1 && free ? 0 : planes.known[i] & word();
  }
  return planes;
}

void set_cell_by_cell(const VoxelIndex& brick, const Planes& planes, OccupancyMap& map) {
  for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
    const Brick cells{planes.known, planes.occupied, {}};
    map.set(Brick::cell_at(brick, offset), cells.at(offset));
  }
}

std::vector<VoxelIndex> written_since(const OccupancyMap& map, OccupancyMap::Revision revision) {
  std::vector<VoxelIndex> written;
  map.for_each_written_since(revision, [&](const VoxelIndex& brick, const Brick&) { written.push_back(brick); });
  return written;
}

TEST(AssignBrick, EqualsSettingEveryCell) {
  std::mt19937 engine(22);
  std::size_t compared = 0;
  std::size_t refused = 0;
  std::size_t outside = 0;
  std::size_t unchanged = 0;
  std::size_t shared = 0;
  for (int world = 0; world < 120; ++world) {
    OccupancyMapOptions options;
    if (world % 3 == 1) {  // cuts through bricks
      options.region = Box{{-1.05, -0.65, -2.0}, {1.2, 1.45, 0.95}};
    }
    options.max_bytes = world % 4 == 3 ? 70'000 : 0;
    OccupancyMap assigned(options);
    OccupancyMap set(options);
    for (int step = 0; step < 25; ++step) {
      if (step % 5 == 4) {
        std::mt19937 same = engine;
        change_around_origin(assigned, engine);
        change_around_origin(set, same);
      }
      const auto coordinate = [&] { return static_cast<std::int32_t>(engine() % 6) - 3; };
      const VoxelIndex brick{coordinate(), coordinate(), coordinate()};
      const Planes planes = random_planes(engine);
      const OccupancyMap::Revision before = assigned.revision();
      const OccupancyMap::Revision before_set = set.revision();
      assigned.assign(brick, planes.known, planes.occupied);
      set_cell_by_cell(brick, planes, set);
      test::expect_equal_maps(assigned, set);
      ASSERT_EQ(assigned.revision() - before, set.revision() == before_set ? 0U : 1U);
      ASSERT_EQ(assigned.changed_since(before), set.changed_since(before_set));
      ASSERT_EQ(assigned.changed_since(0), set.changed_since(0));
      ASSERT_EQ(written_since(assigned, before), written_since(set, before_set));
      outside += assigned.revision() == before ? 1U : 0U;
      unchanged += assigned.changed_since(before).empty() ? 1U : 0U;
      ++compared;
      shared += assigned.resident_bytes() < assigned.memory_bytes() ? 1U : 0U;
      if (step % 10 == 9) {
        const OccupancyMap before_change(assigned);
        std::mt19937 same = engine;
        change_around_origin(assigned, same);
        test::expect_equal_maps(before_change, set);
        assigned = before_change;
      }
    }
    refused += assigned.cells_refused();
  }
  EXPECT_EQ(compared, 3000U);
  EXPECT_GT(refused, 1000U);
  EXPECT_GT(outside, 100U);
  EXPECT_GT(shared, 100U);
  EXPECT_GT(unchanged, outside + 100U);
}

// However large a free room is, only what stands in it takes bricks. A scan through free space changes nothing there.
TEST(AssignBrick, FreeSpaceIsKeptOnce) {
  BrickPlane all;
  all.fill(~std::uint64_t{0});
  const auto bytes_of_room = [&](std::int32_t bricks) {
    OccupancyMap map;
    for_each_cell({{0, 0, 0}, {bricks, bricks, bricks}},
                  [&](const VoxelIndex& brick) { map.assign(brick, all, BrickPlane{}); });
    const std::size_t before = map.resident_bytes();
    Scan scan;
    scan.world_from_sensor.translation() = Eigen::Vector3d(0.4, 0.4, 0.4);
    for (int ray = 0; ray < 100; ++ray) {
      scan.points.emplace_back(0.001F * static_cast<float>(ray), 0.0F, 1.0F);
    }
    EXPECT_EQ(map.insert(scan).cells_cleared, 9U);
    EXPECT_EQ(map.resident_bytes(), before + sizeof(Brick)) << "the brick in which the rays end";
    EXPECT_EQ(written_since(map, map.revision() - 1).size(), 1U);
    return before;
  };
  const auto small = static_cast<double>(bytes_of_room(8));
  const auto large = static_cast<double>(bytes_of_room(24));
  EXPECT_LT((large - small) / (24.0 * 24.0 * 24.0 - 512.0), 100.0) << "bytes of a brick of 512 cells";
}

TEST(AssignBrick, RefusesWhatHasNoMeaning) {
  OccupancyMap map;
  BrickPlane one{};
  one[3] = 4;
  EXPECT_THROW(map.assign({}, {}, one), std::invalid_argument);
  constexpr std::int32_t kFurthest = kFurthestVoxel >> 3;
  EXPECT_THROW(map.assign({0, kFurthest + 1, 0}, one, {}), std::invalid_argument);
  EXPECT_THROW(map.assign({0, 0, -kFurthest - 1}, one, {}), std::invalid_argument);
  EXPECT_EQ(map.revision(), 0U);
  map.assign({-kFurthest, kFurthest, 0}, one, {});
  EXPECT_EQ(map.counts().free, 1U);
}

}  // namespace
}  // namespace vantage
