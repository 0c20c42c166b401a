// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <random>
#include <utility>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_clusters.hpp>

#include "random_laplace.hpp"
#include "random_rooms.hpp"

namespace vantage {
namespace {

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(LaplaceMultigrid, NamesTheOptionAtFault) {
  const auto error = [](const MultigridOptions& options) { return error_of([&] { options.validate(); }); };
  EXPECT_NE(error({.tolerance = 0.0}).find("MultigridOptions::tolerance"), std::string::npos);
  EXPECT_NE(error({.tolerance = 1.0}).find("MultigridOptions::tolerance"), std::string::npos);
  EXPECT_NE(error({.uniform_source = -1.0}).find("MultigridOptions::uniform_source"), std::string::npos);
  EXPECT_NE(error({.max_iterations = 0}).find("MultigridOptions::max_iterations"), std::string::npos);
  EXPECT_NE(error({.threads = 0}).find("MultigridOptions::threads"), std::string::npos);
  EXPECT_EQ(error({}), "");
}

TEST(LaplaceMultigrid, RefusesASourceThatDoesNotFit) {
  LaplaceDomain domain;
  domain.insert({0, 0, 0});
  domain.insert_sink({1, 0, 0});
  EXPECT_NE(error_of([&] {
              LaplaceMultigrid(domain, {5, 0, 0});
            }).find("(5, 0, 0) is not in the domain"),
            std::string::npos);
  EXPECT_NE(error_of([&] { LaplaceMultigrid(domain, {1, 0, 0}); }).find("(1, 0, 0) is a sink"), std::string::npos);
}

TEST(LaplaceMultigrid, OneCellBetweenSinks) {
  LaplaceDomain domain;
  domain.insert({-1, 0, 0});
  domain.insert_sink({0, 0, 0});
  domain.insert_sink({-2, 0, 0});
  const LaplaceMultigrid field(domain, {-1, 0, 0});
  EXPECT_TRUE(field.report().certified);
  EXPECT_EQ(field.phi({-1, 0, 0}), 1.0);
  EXPECT_EQ(field.phi({0, 0, 0}), 0.0);
  EXPECT_EQ(field.phi({1, 0, 0}), std::nullopt);
}

TEST(LaplaceMultigrid, WithoutSinksThereIsNothingToSolve) {
  LaplaceDomain domain;
  domain.insert({0, 0, 0});
  domain.insert({1, 0, 0});
  const LaplaceMultigrid field(domain, {0, 0, 0});
  EXPECT_EQ(field.report().stop, MultigridStop::NoSinks);
  EXPECT_FALSE(field.report().certified);
  EXPECT_EQ(field.report().stuck_cells, 2U);
  EXPECT_EQ(field.phi({1, 0, 0}), 1.0);
}

// A straight corridor: the field is a ramp, through many bricks and below zero.
TEST(LaplaceMultigrid, ACorridorIsARamp) {
  for (const int axis : {0, 1, 2}) {
    const auto at = [&](std::int32_t i) {
      return axis == 0 ? VoxelIndex{i, 3, -5} : axis == 1 ? VoxelIndex{3, i, -5} : VoxelIndex{3, -5, i};
    };
    LaplaceDomain domain;
    for (std::int32_t i = -100; i < 100; ++i) {
      domain.insert(at(i));
    }
    domain.insert_sink(at(100));
    const LaplaceMultigrid field(domain, at(-100), {.tolerance = 1e-12, .uniform_source = 1e-9});
    ASSERT_TRUE(field.report().certified);
    for (std::int32_t i = -100; i <= 100; ++i) {
      ASSERT_NEAR(*field.phi(at(i)), (100 - i) / 200.0, 1e-8);
    }
  }
}

TEST(LaplaceMultigrid, StopsAtItsLimit) {
  const RandomRooms rooms({.seed = 3});
  const LaplaceMultigrid field(rooms.domain(), rooms.source, {.max_iterations = 2});
  EXPECT_EQ(field.report().stop, MultigridStop::IterationLimit);
  EXPECT_EQ(field.report().iterations, 2U);
  EXPECT_GT(field.report().residual, 1e-8);
}

// Components against those of the list, which finds them cell by cell.
TEST(LaplaceDomain, KeepsTheComponentAndCountsTheOthers) {
  std::mt19937 engine(41);
  std::size_t dropped = 0;
  std::size_t components = 0;
  for (int world = 0; world < 400; ++world) {
    RandomLaplace random(engine, world % 2 == 0 ? 6 : 40);
    if (world % 2 != 0) {  // large and thin: many components
      std::bernoulli_distribution open(0.4);
      std::erase_if(random.cells, [&](const VoxelIndex& cell) { return cell != random.source && !open(engine); });
    }
    LaplaceDomain domain;
    for (const VoxelIndex& cell : random.cells) {
      domain.insert(cell);
    }
    const LaplaceProblem problem(random.cells, {}, random.source);
    const auto found = domain.keep_component(random.source);
    ASSERT_EQ(found.cells, problem.dropped_cells()) << "world " << world;
    ASSERT_EQ(domain.cell_count(), problem.size());
    for (const VoxelIndex& cell : problem.cells()) {
      ASSERT_TRUE(domain.contains(cell));
    }
    ASSERT_EQ(found.components + 1, voxel_clusters(random.cells, Connectivity::Face6).size());
    dropped += found.cells;
    components += found.components;
  }
  EXPECT_GE(dropped, 10000U);
  EXPECT_GE(components, 1000U);
}

TEST(LaplaceDomain, OfAMapHoldsItsFreeCellsAndFrontiers) {
  std::mt19937 engine(42);
  OccupancyMap map({.resolution_m = 0.1});
  std::uniform_int_distribution<int> state(0, 5);
  for_each_cell({{-13, -9, -20}, {14, 11, 5}}, [&](const VoxelIndex& cell) {
    const int drawn = state(engine);
    map.set(cell, drawn == 0 ? Occupancy::Unknown : drawn == 1 ? Occupancy::Occupied : Occupancy::Free);
  });
  LaplaceDomain domain = known_free_domain(map);
  EXPECT_EQ(domain.cell_count(), map.counts().free);
  EXPECT_EQ(domain.sink_count(), frontier_cells(map).size());
  EXPECT_GE(domain.sink_count(), 1000U);
  for (const VoxelIndex& cell : frontier_cells(map)) {
    const LaplaceDomain::Brick& brick = domain.bricks()[domain.position_of_brick(cell)];
    ASSERT_NE(brick.sinks[LaplaceDomain::row_of(cell)] & LaplaceDomain::bit_of(cell), 0);
  }
}

// Against the definition, column by column; then the field is solved in the plane.
TEST(LaplaceDomain, OfAHeightBandIsItsProjection) {
  std::mt19937 engine(43);
  const VoxelBox region{{-20, -17, -6}, {21, 19, 12}};
  std::uniform_int_distribution<int> draw(0, 99);
  std::size_t cells = 0;
  std::size_t sinks = 0;
  for (const auto& [lowest, highest] : std::vector<std::pair<std::int32_t, std::int32_t>>{{-3, 4}, {2, 2}, {5, 9}}) {
    OccupancyMap map({.resolution_m = 0.1, .region = Box{{-2.0, -1.7, -0.6}, {2.1, 1.9, 1.2}}});
    for_each_cell(region, [&](const VoxelIndex& cell) {
      const int drawn = draw(engine);
      map.set(cell, drawn < 2 ? Occupancy::Unknown : drawn < 4 ? Occupancy::Occupied : Occupancy::Free);
    });
    const auto count = [&](std::int32_t x, std::int32_t y, Occupancy state) {
      std::int32_t cells_of_state = 0;
      for (std::int32_t z = lowest; z <= highest; ++z) {
        cells_of_state += region.contains({x, y, z}) && map.at({x, y, z}) == state ? 1 : 0;
      }
      return cells_of_state;
    };
    const auto is_unknown = [&](std::int32_t x, std::int32_t y) {
      return region.contains({x, y, lowest}) && count(x, y, Occupancy::Occupied) == 0 &&
             count(x, y, Occupancy::Unknown) > 0;
    };
    const LaplaceDomain plane = known_free_plane(map, lowest, highest);
    std::optional<VoxelIndex> source;
    for_each_cell({{-25, -25, lowest}, {25, 25, lowest + 1}}, [&](const VoxelIndex& cell) {
      const bool is_free = count(cell.x, cell.y, Occupancy::Free) == highest - lowest + 1;
      ASSERT_EQ(plane.contains(cell), is_free);
      if (!is_free) {
        return;
      }
      const bool is_sink = is_unknown(cell.x - 1, cell.y) || is_unknown(cell.x + 1, cell.y) ||
                           is_unknown(cell.x, cell.y - 1) || is_unknown(cell.x, cell.y + 1);
      const LaplaceDomain::Brick& brick = plane.bricks()[plane.position_of_brick(cell)];
      ASSERT_EQ((brick.sinks[LaplaceDomain::row_of(cell)] & LaplaceDomain::bit_of(cell)) != 0, is_sink);
      source = is_sink ? source : std::optional(cell);
    });
    cells += plane.cell_count();
    sinks += plane.sink_count();
    ASSERT_TRUE(source);
    const LaplaceMultigrid field(plane, *source);
    EXPECT_TRUE(field.report().certified || field.report().stop == MultigridStop::NoSinks);
  }
  EXPECT_GE(cells, 2000U);
  EXPECT_GE(sinks, 300U);
  EXPECT_NE(error_of([] { (void)known_free_plane(OccupancyMap({.resolution_m = 0.1}), 3, 2); }).find("highest is 2"),
            std::string::npos);
}

}  // namespace
}  // namespace vantage
