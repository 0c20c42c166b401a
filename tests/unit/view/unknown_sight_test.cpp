// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <support/hollow_map.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/view/unknown_sight.hpp>

namespace vantage {
namespace {

RangeSensor camera(double min_range_m = 0.0) { return RangeSensor::pinhole(48, 36, 1.2, 0.9, min_range_m, 6.0); }

std::vector<VoxelIndex> cells_of(const std::vector<SightedCell>& seen) {
  std::vector<VoxelIndex> cells;
  for (const SightedCell& one : seen) {
    cells.push_back(one.cell);
  }
  return cells;
}

// With opaque cells, the result is the first cell of each ray.
TEST(UnknownSight, OpaqueItIsTheFirstCellOfEachRay) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  std::size_t compared = 0;
  for (int round = 0; round < 5; ++round) {
    const OccupancyMap map = test::hollow_map(engine, 0.1);
    const std::vector<VoxelIndex> wanted = void_cells(map);
    const RayCaster caster(map);
    const UnknownSight sight(map, BrickSet(wanted), {});
    const ViewRays rays(camera(round % 2 == 0 ? 0.0 : 0.4));
    for (int view = 0; view < 5; ++view) {
      const Pose pose = pose_looking({0.05, 0.05, 0.05}, angle(engine), 0.4 * angle(engine));
      const CellSet seen = caster.visible_cells(pose, rays, map.bounds());
      std::vector<VoxelIndex> expected;
      std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(expected),
                   [&](const VoxelIndex& cell) { return seen.contains(cell); });
      std::uint64_t operations = 0;
      const std::vector<SightedCell> looked = sight.look(caster, pose, rays, operations);
      EXPECT_GT(operations, rays.size());
      EXPECT_EQ(looked.size(), expected.size());
      for (const SightedCell& one : looked) {
        EXPECT_TRUE(seen.contains(one.cell));
        EXPECT_EQ(one.chance, 1.0);
      }
      compared += expected.size();
    }
  }
  EXPECT_GT(compared, 500U);
}

// A corridor along x, one cell wide: free up to x = 5, unknown up to `end`, optionally with a wall behind it.
struct Corridor {
  explicit Corridor(int end, bool wall) : map({.resolution_m = 0.1}) {
    for (int x = 0; x < end; ++x) {
      if (x < 5) {
        map.set({x, 0, 0}, Occupancy::Free);
      } else {
        wanted.push_back({x, 0, 0});
      }
    }
    map.set({end, 0, 0}, wall ? Occupancy::Occupied : Occupancy::Free);
  }
  [[nodiscard]] std::vector<SightedCell> look(const UnknownSightOptions& options, double min_range_m = 0.0) {
    const ViewRays ray({Eigen::Vector3f::UnitZ()}, 1, 1, 3.0, min_range_m);
    operations = 0;
    return UnknownSight(map, BrickSet(wanted), options)
        .look(RayCaster(map), pose_looking({0.05, 0.05, 0.05}, 0.0), ray, operations);
  }

  OccupancyMap map;
  std::vector<VoxelIndex> wanted;
  std::uint64_t operations = 0;  // of the last look
};

constexpr double kStep = 1e-4;  // resolution of stored probabilities

TEST(UnknownSight, FollowsItsFormula) {
  Corridor corridor(12, true);
  const std::vector<SightedCell> seen = corridor.look({.opaque_share = 0.2, .opaque_beside_surface = 0.5});
  ASSERT_EQ(cells_of(seen), corridor.wanted);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_NEAR(seen[k].chance, std::pow(0.8, static_cast<double>(k)), kStep) << k;
  }
  EXPECT_EQ(corridor.operations, 13U) << "the cells up to the wall, and the wall";
}

TEST(UnknownSight, WithoutReturnsAnOpenWayTeachesLess) {
  Corridor corridor(12, false);
  const UnknownSightOptions blind{.opaque_share = 0.2, .opaque_beside_surface = 0.5};
  const std::vector<SightedCell> seen = corridor.look(blind);
  ASSERT_EQ(seen.size(), 7U);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const double reached = std::pow(0.8, static_cast<double>(k));
    EXPECT_NEAR(seen[k].chance, reached * (1.0 - std::pow(0.8, static_cast<double>(7 - k))), kStep) << k;
  }
  const std::vector<SightedCell> told =
      corridor.look({.opaque_share = 0.2, .opaque_beside_surface = 0.5, .reports_no_return = true});
  EXPECT_NEAR(told.back().chance, std::pow(0.8, 6.0), kStep);
}

TEST(UnknownSight, SurfacesGoOn) {
  Corridor corridor(12, true);
  corridor.map.set({7, 0, 1}, Occupancy::Occupied);
  const std::vector<SightedCell> seen = corridor.look({.opaque_share = 0.2, .opaque_beside_surface = 0.5});
  EXPECT_NEAR(seen[2].chance, 0.64, kStep) << "it is reached as before";
  EXPECT_NEAR(seen[3].chance, 0.32, kStep) << "but half of the rays end in it";
}

TEST(UnknownSight, WhatIsTooNearReturnsNothing) {
  Corridor corridor(8, true);
  EXPECT_EQ(corridor.look({.opaque_share = 0.2, .opaque_beside_surface = 0.5}, 0.65).size(), 1U)
      << "of three cells the last is in range, and so is the wall";
  EXPECT_TRUE(corridor.look({.opaque_share = 0.2, .opaque_beside_surface = 0.5}, 0.85).empty()) << "nor is the wall";
}

TEST(UnknownSight, RefusesWhatIsNoChance) {
  const OccupancyMap map({.resolution_m = 0.1});
  EXPECT_THROW(UnknownSight(map, {}, {.opaque_share = 0.0}), std::invalid_argument);
  EXPECT_THROW(UnknownSight(map, {}, {.opaque_beside_surface = 1.5}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
