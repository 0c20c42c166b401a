// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <random>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_clusters.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/robot/reachable_cells.hpp>

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

// In a straight corridor, the field is linear. It spans many bricks and negative coordinates.
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

// Compares the component with a plain flood, cell by cell.
LaplaceDomain::Dropped keep_one(const std::vector<VoxelIndex>& cells, const VoxelIndex& source) {
  LaplaceDomain domain;
  for (const VoxelIndex& cell : cells) {
    domain.insert(cell);
  }
  const std::vector<VoxelIndex> joined = reachable_cells(
      source, detail::box_around(cells), [&](const VoxelIndex& cell) { return domain.contains(cell); });
  const LaplaceDomain::Dropped found = domain.keep_component(source);
  EXPECT_EQ(found.cells, cells.size() - joined.size());
  EXPECT_EQ(domain.cell_count(), joined.size());
  for (const VoxelIndex& cell : joined) {
    EXPECT_TRUE(domain.contains(cell));
  }
  EXPECT_EQ(found.components + 1, voxel_clusters(cells, Connectivity::Face6).size());
  return found;
}

TEST(LaplaceDomain, KeepsTheComponentAndCountsTheOthers) {
  std::mt19937 engine(41);
  std::size_t dropped = 0;
  std::size_t components = 0;
  for (int world = 0; world < 400 && !HasFailure(); ++world) {
    RandomLaplace random(engine, world % 2 == 0 ? 6 : 40);
    if (world % 2 != 0) {  // large and sparse: many components
      std::bernoulli_distribution open(0.4);
      std::erase_if(random.cells, [&](const VoxelIndex& cell) { return cell != random.source && !open(engine); });
    }
    const LaplaceDomain::Dropped found = keep_one(random.cells, random.source);
    dropped += found.cells;
    components += found.components;
  }
  EXPECT_FALSE(HasFailure());
  EXPECT_GE(dropped, 10000U);
  EXPECT_GE(components, 1000U);
}

// A wall of one cell across everything, with or without a hole of 2 x 2 cells.
struct CrossWall {
  std::size_t axis;
  VoxelIndex through;
  bool has_hole;

  [[nodiscard]] bool closes(const VoxelIndex& cell) const {
    const VoxelIndex off = cell - through;
    const std::array<std::int32_t, 3> offset{off.x, off.y, off.z};
    const auto in_hole = [&](std::size_t other) { return other == axis || offset[other] == 0 || offset[other] == 1; };
    return offset[axis] == 0 && !(has_hole && in_hole(0) && in_hole(1) && in_hole(2));
  }
};

// Halls of full bricks with walls between them.
TEST(LaplaceDomain, KeepsTheHallsThatHangTogether) {
  std::mt19937 engine(44);
  std::uniform_int_distribution<std::int32_t> place(-20, 20);
  std::bernoulli_distribution has_hole(0.7);
  std::size_t apart = 0;
  std::size_t components = 0;
  for (int world = 0; world < 60 && !HasFailure(); ++world) {
    std::vector<CrossWall> walls;
    for (std::size_t wall = 0; wall < 5; ++wall) {
      walls.push_back({wall % 3, {2 * place(engine), place(engine), place(engine)}, has_hole(engine)});
    }
    std::vector<VoxelIndex> cells;
    for_each_cell({{-40, -20, -20}, {40, 20, 20}}, [&](const VoxelIndex& cell) {
      if (std::none_of(walls.begin(), walls.end(), [&](const CrossWall& wall) { return wall.closes(cell); })) {
        cells.push_back(cell);
      }
    });
    std::uniform_int_distribution<std::size_t> any(0, cells.size() - 1);
    const LaplaceDomain::Dropped found = keep_one(cells, cells[any(engine)]);
    apart += found.components > 0 ? 1 : 0;
    components += found.components;
  }
  EXPECT_FALSE(HasFailure());
  EXPECT_GE(apart, 30U);
  EXPECT_GE(components, 60U);
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

// The field of a ground robot: certified and two-dimensional, because no flow leaves the plane.
TEST(LaplaceDomain, OfAHeightBandIsAPlane) {
  std::mt19937 engine(43);
  std::uniform_int_distribution<int> draw(0, 99);
  std::size_t cells = 0;
  for (const HeightBandOptions& options : std::vector<HeightBandOptions>{{.min_height_m = -0.3,
                                          .max_height_m = 0.45,
                                          .sensor_height_m = 0.1,
                                          .free_share = 1.0,
                                          .needs_floor = false},
                                                                         {.min_height_m = 0.2,
                                                                         .max_height_m = 0.3,
                                                                         .sensor_height_m = 0.25,
                                                                         .free_share = 1.0,
                                                                         .needs_floor = false},
                                                                         {.min_height_m = 0.5,
                                                                         .max_height_m = 0.9,
                                                                         .sensor_height_m = 0.6,
                                                                         .free_share = 0.5,
                                                                         .needs_floor = false}}) {
    OccupancyMap map({.resolution_m = 0.1, .region = Box{{-2.0, -1.7, -0.6}, {2.1, 1.9, 1.2}}});
    for_each_cell(*map.region(), [&](const VoxelIndex& cell) {
      const int drawn = draw(engine);
      map.set(cell, drawn < 2 ? Occupancy::Unknown : drawn < 4 ? Occupancy::Occupied : Occupancy::Free);
    });
    HeightBand band(map.options(), options);
    band.follow(map);
    const LaplaceDomain plane = known_free_domain(band.plane());
    std::optional<VoxelIndex> source;
    band.plane().for_each_clear([&](const VoxelIndex& cell) {
      ASSERT_TRUE(plane.contains(cell));
      const LaplaceDomain::Brick& brick = plane.bricks()[plane.position_of_brick(cell)];
      const bool is_sink = (brick.sinks[LaplaceDomain::row_of(cell)] & LaplaceDomain::bit_of(cell)) != 0;
      source = is_sink ? source : std::optional(cell);
    });
    EXPECT_EQ(plane.cell_count(), band.plane().counts().free);
    cells += plane.cell_count();
    ASSERT_TRUE(source);
    const LaplaceMultigrid field(plane, *source);
    EXPECT_TRUE(field.report().certified || field.report().stop == MultigridStop::NoSinks);
  }
  EXPECT_GE(cells, 2000U);
}

}  // namespace
}  // namespace vantage
