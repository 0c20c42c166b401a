// SPDX-License-Identifier: MIT
// One-shot functions over the map of a host equal those of a map of vantage that mirrors it.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/map/map_follower.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/reachable_cells.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vector>

#include "support/grid_host.hpp"
#include "support/random_maps.hpp"

namespace vantage {
namespace {

using test::GridHost;

constexpr VoxelBox kOwnGrid{{-19, -13, -7}, {20, 17, 11}};
constexpr VoxelFrame kOwnFrame{0.1};

// The region of the map has the cells of the grid.
OccupancyMapOptions options_of_grid() { return {.resolution_m = 0.1, .region = kOwnFrame.box_of(kOwnGrid)}; }

// A host, and its mirror.
struct World {
  GridHost host{kOwnGrid};
  MapFollower follower{options_of_grid()};

  explicit World(std::mt19937& engine) {
    for_each_cell(kOwnGrid.grown(-2), [&](const VoxelIndex& cell) { host.set(cell, Occupancy::Free); });
    for (int i = 0; i < 20; ++i) {
      test::change(host, engine);
    }
    follower.update(host, kOwnGrid);
  }
};

Eigen::Vector3d random_point(std::mt19937& engine) {
  const Box box = kOwnFrame.box_of(kOwnGrid);
  std::uniform_real_distribution<double> part(0.001, 0.999);
  return box.min + Eigen::Vector3d(part(engine), part(engine), part(engine)).cwiseProduct(box.extent());
}

TEST(OwnMap, HasTheFrontiersAndTheFieldOfItsMirror) {
  std::mt19937 engine(51);
  std::size_t frontier = 0;
  for (int i = 0; i < 60; ++i) {
    const World world(engine);
    const std::vector<VoxelIndex> cells = frontier_cells(world.host, kOwnGrid);
    ASSERT_EQ(cells, frontier_cells(world.follower.map()));
    ASSERT_EQ(cells, frontier_cells(world.follower.map(), kOwnGrid));
    const LaplaceDomain ours = known_free_domain(world.host, kOwnGrid);
    const LaplaceDomain theirs = known_free_domain(world.follower.map());
    ASSERT_EQ(ours.cell_count(), theirs.cell_count());
    ASSERT_EQ(ours.sink_count(), theirs.sink_count());
    ASSERT_EQ(ours.sink_count(), cells.size());
    for_each_cell(kOwnGrid, [&](const VoxelIndex& cell) { ASSERT_EQ(ours.contains(cell), theirs.contains(cell)); });
    frontier += cells.size();
  }
  EXPECT_GT(frontier, 20'000U);
}

TEST(OwnMap, SeesWhatItsMirrorSees) {
  std::mt19937 engine(52);
  std::size_t seen = 0;
  std::size_t hidden = 0;
  for (int i = 0; i < 60; ++i) {
    const World world(engine);
    const RayCaster caster(world.follower.map());
    for (int ray = 0; ray < 500; ++ray) {
      const Eigen::Vector3d from = random_point(engine);
      const Eigen::Vector3d to = random_point(engine);
      ASSERT_EQ(first_not_free(world.host, kOwnFrame, from, to), caster.cast(from, to));
      std::uint64_t operations = 0;
      std::uint64_t of_mirror = 0;
      const bool sight = in_plain_sight(world.host, kOwnFrame, from, kOwnFrame.cell_of(to), operations);
      ASSERT_EQ(sight, in_plain_sight(world.follower.map(), from, kOwnFrame.cell_of(to), of_mirror));
      ASSERT_EQ(operations, of_mirror);
      (sight ? seen : hidden) += 1;
    }
  }
  EXPECT_GT(seen, 300U);
  EXPECT_GT(hidden, 500U);
}

// A rule of the host (the cell and those beside it are free) and a platform that asks the mirror.
TEST(OwnMap, IsReachedWhereItsMirrorIs) {
  std::mt19937 engine(53);
  std::size_t reached = 0;
  std::size_t starts = 0;
  const FreeFlyer robot(FreeFlyerOptions{.radius_m = 0.12});
  for (int i = 0; i < 60; ++i) {
    const World world(engine);
    const OccupancyMap& map = world.follower.map();
    const VoxelIndex start = kOwnFrame.cell_of(random_point(engine));
    if (!robot.admits_cell(map, start)) {
      continue;
    }
    ++starts;
    const ReachableSpace space(map, robot, pose_looking(kOwnFrame.centre_of(start), 0.0));
    ASSERT_EQ(space.start(), start);
    std::vector<VoxelIndex> expected = space.cells();
    std::sort(expected.begin(), expected.end());
    const auto sorted = [&](const auto& admits) {
      std::vector<VoxelIndex> cells = reachable_cells(start, kOwnGrid, admits);
      std::sort(cells.begin(), cells.end());
      return cells;
    };
    ASSERT_EQ(sorted([&](const VoxelIndex& cell) { return robot.admits_cell(map, cell); }), expected);
    // A ball of 0.12 m around the centre of a cell of 0.1 m touches its 26 neighbours.
    ASSERT_EQ(sorted([&](const VoxelIndex& cell) {
                return world.host.at(cell) == Occupancy::Free &&
                       std::all_of(kAllNeighbours.begin(), kAllNeighbours.end(), [&](const VoxelIndex& by) {
                         return kOwnGrid.contains(cell + by) && world.host.at(cell + by) == Occupancy::Free;
                       });
              }),
              expected);
    reached += expected.size();
  }
  EXPECT_GT(starts, 5U);
  EXPECT_GT(reached, 2000U);
  EXPECT_TRUE(reachable_cells({}, VoxelBox{}, [](const VoxelIndex&) { return true; }).empty());
}

// Without a body: the component of the start in the known free domain, the space of a ball that fits in a cell.
TEST(OwnMap, IsReachedWithoutABodyWhereItsMirrorIs) {
  std::mt19937 engine(54);
  std::size_t reached = 0;
  std::size_t beyond = 0;
  const FreeFlyer point(FreeFlyerOptions{.radius_m = 0.04, .margin_m = 0.0});
  for (int i = 0; i < 60; ++i) {
    const World world(engine);
    const VoxelIndex start = kOwnFrame.cell_of(random_point(engine));
    std::vector<VoxelIndex> cells = reachable_cells(world.host, start, kOwnGrid);
    ASSERT_EQ(cells, reachable_cells(world.follower.map(), start, kOwnGrid));
    if (world.host.at(start) != Occupancy::Free) {
      ASSERT_TRUE(cells.empty());
      continue;
    }
    LaplaceDomain domain = known_free_domain(world.host, kOwnGrid);
    beyond += domain.keep_component(start).cells;
    ASSERT_EQ(cells.size(), domain.cell_count());
    ASSERT_TRUE(std::all_of(cells.begin(), cells.end(), [&](const auto& cell) { return domain.contains(cell); }));
    std::vector<VoxelIndex> space =
        ReachableSpace(world.follower.map(), point, pose_looking(kOwnFrame.centre_of(start), 0.0)).cells();
    std::sort(cells.begin(), cells.end());
    std::sort(space.begin(), space.end());
    ASSERT_EQ(cells, space);
    reached += cells.size();
  }
  EXPECT_GT(reached, 200'000U);
  EXPECT_GT(beyond, 10U);
}

}  // namespace
}  // namespace vantage
