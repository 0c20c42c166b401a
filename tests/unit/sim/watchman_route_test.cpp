// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/sim/watchman_route.hpp>
#include <vantage/sim/world.hpp>

#include "sim/shortest_visit.hpp"
#include "sim/sight.hpp"

namespace vantage {
namespace {

constexpr double kCellM = 0.2;

// Rooms in a row, with doors alternately on the left and the right.
World row_of_rooms(int rooms) {
  VoxelGrid<std::uint8_t> solid({{0, 0, 0}, {7 * rooms + 1, 9, 6}}, 1);
  for (std::int32_t room = 0; room < rooms; ++room) {
    for_each_cell({{7 * room + 1, 1, 1}, {7 * room + 7, 8, 5}}, [&](const VoxelIndex& cell) { solid[cell] = 0; });
    const std::int32_t door = room % 2 == 0 ? 1 : 4;
    if (room + 1 < rooms) {
      for_each_cell({{7 * room + 7, door, 1}, {7 * room + 8, door + 4, 5}},
                    [&](const VoxelIndex& cell) { solid[cell] = 0; });
    }
  }
  return {"row", surface_of_cells(solid, {kCellM}, 0.01), {{0, 0, 0}, {kCellM * (7 * rooms + 1), 1.8, 1.2}}};
}

struct InARow {
  explicit InARow(int rooms) : world(row_of_rooms(rooms)) {}
  [[nodiscard]] WatchmanRoute route(const WatchmanOptions& options = {}) const {
    return watchman_route(truth, flyer, sensor, start, options);
  }
  [[nodiscard]] std::vector<VoxelIndex> unseen_from(const std::vector<VoxelIndex>& cells) const {
    const Sight sight(truth.cells(), truth.map().frame(), sensor, true);
    std::vector<VoxelIndex> unseen;
    for (const VoxelIndex& cell : truth.observable(flyer, sensor, start)) {
      if (std::none_of(cells.begin(), cells.end(), [&](const auto& from) { return sight.sees_part(from, cell); })) {
        unseen.push_back(cell);
      }
    }
    return unseen;
  }
  World world;
  Truth truth{world, kCellM, world.region};
  FreeFlyer flyer{FreeFlyerOptions{.radius_m = 0.15}};
  RangeSensor sensor = RangeSensor::preset("panoramic");
  Pose start = pose_looking({0.7, 0.9, 0.5}, 0.0);
};

TEST(WatchmanRoute, OneRoomIsSeenFromWhereItStands) {
  const WatchmanRoute route = InARow(1).route();
  EXPECT_TRUE(route.sees_all);
  EXPECT_EQ(route.length_m, 0.0);
  EXPECT_EQ(route.cells.size(), 1U);
  EXPECT_TRUE(route.witnesses.empty());
}

TEST(WatchmanRoute, SeesEverythingWhateverTheThreads) {
  const InARow row(4);
  const WatchmanRoute route = row.route();
  EXPECT_TRUE(route.sees_all);
  EXPECT_EQ(route.seen, 1.0);
  EXPECT_TRUE(row.unseen_from(route.cells).empty());
  EXPECT_GT(route.length_m, 2.0) << "into the third room at least";
  EXPECT_LT(route.length_m, 7.0 * 4 * kCellM);
  EXPECT_EQ(row.route({.threads = 3}).cells, route.cells);
}

// Random routes that see everything are never shorter.
TEST(WatchmanRoute, NoWayThatSeesEverythingIsShorter) {
  std::size_t ways = 0;
  for (int rooms = 2; rooms <= 3; ++rooms) {
    const InARow row(rooms);
    const double bound_m = row.route().length_m;
    const NumberedCells space(ReachableSpace(row.truth.map(), row.flyer, row.start));
    const StepGraph graph(space);
    double shortest_m = 1e9;
    std::mt19937 engine(static_cast<std::uint32_t>(rooms));
    for (int way = 0; way < 150; ++way, ++ways) {
      std::vector<VoxelIndex> cells{space.cells()[0]};
      std::uint32_t here = 0;
      double length = 0.0;
      std::vector<VoxelIndex> unseen = row.unseen_from(cells);
      while (!unseen.empty()) {
        const std::vector<std::uint32_t> from{here};
        const std::vector<float> distance = distances_from(graph, from);
        const auto next = static_cast<std::uint32_t>(engine() % space.size());
        length += distance[next];
        here = next;
        const Sight sight(row.truth.cells(), row.truth.map().frame(), row.sensor, true);
        unseen.erase(std::remove_if(unseen.begin(), unseen.end(),
                                    [&](const auto& cell) { return sight.sees_part(space.cells()[here], cell); }),
                     unseen.end());
      }
      shortest_m = std::min(shortest_m, kCellM * length);
    }
    EXPECT_GE(shortest_m, bound_m - 1e-4) << rooms << " rooms";
    EXPECT_LE(shortest_m, 2.5 * bound_m) << "or nothing near it was tried";
  }
  EXPECT_EQ(ways, 300U);
}

TEST(WatchmanRoute, FewerWitnessesProveLess) {
  const InARow row(4);
  const WatchmanRoute whole = row.route();
  ASSERT_GT(whole.witnesses.size(), 1U);
  const WatchmanRoute one = row.route({.max_witnesses = 1});
  EXPECT_FALSE(one.sees_all);
  EXPECT_LT(one.seen, 1.0);
  EXPECT_EQ(one.witnesses.size(), 1U);
  EXPECT_LE(one.length_m, whole.length_m);
}

TEST(WatchmanRoute, RefusesWhatItCannotDo) {
  const InARow row(2);
  EXPECT_THROW((void)row.route({.max_witnesses = 0}), std::invalid_argument);
  EXPECT_THROW((void)row.route({.max_witnesses = 13}), std::invalid_argument);
  EXPECT_THROW((void)row.route({.threads = 0}), std::invalid_argument);
  EXPECT_THROW((void)watchman_route(row.truth, row.flyer, row.sensor, pose_looking({9.0, 9.0, 9.0}, 0.0)),
               std::invalid_argument);
}

}  // namespace
}  // namespace vantage
