// SPDX-License-Identifier: MIT
// The first cell along a ray that is not free: every fast algorithm against a walk through all cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <support/hollow_map.hpp>
#include <support/random_maps.hpp>
#include <support/real_data.hpp>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/impl/slice_walk.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vector>

#include "support/sanitized.hpp"

namespace vantage {
namespace {

using detail::BlockingGrid;
using detail::CellStamps;
using detail::instruction_sets;
using detail::InstructionSet;
using detail::RayBlock;
using detail::RayPlacer;
using detail::SensorFrame;
using detail::SliceWalk;
using detail::TileHits;

constexpr VoxelBox kEverywhere{{-kFurthestVoxel, -kFurthestVoxel, -kFurthestVoxel},
                               {kFurthestVoxel, kFurthestVoxel, kFurthestVoxel}};

// A point anywhere, in a lattice plane, or in the centre of a cell.
Eigen::Vector3d random_point(std::mt19937& engine, const VoxelFrame& frame, double reach_m) {
  std::uniform_real_distribution<double> metre(-reach_m, reach_m);
  Eigen::Vector3d point(metre(engine), metre(engine), metre(engine));
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::uint32_t kind = engine() % 16;
    if (kind < 2) {
      point[axis] = frame.size_m * std::round(point[axis] / frame.size_m);
    } else if (kind == 2) {
      point[axis] = frame.centre_of(frame.cell_of(point))[axis];
    }
  }
  return point;
}

TEST(RayCaster, OneRayAtATimeFindsWhatTheSlowWalkFinds) {
  std::mt19937 engine(31);
  std::array<std::size_t, 3> ends{};
  constexpr int kWorlds = test::kSanitized ? 30 : 100;
  std::size_t differing = 0;
  for (int world = 0; world < kWorlds; ++world) {
    const double size_m = world % 3 == 0 ? 0.25 : 0.07;
    const OccupancyMap map = world % 4 == 0 ? test::random_map(engine, size_m) : test::hollow_map(engine, size_m);
    const RayCaster caster(map);
    for (int i = 0; i < 10'000; ++i) {
      const Eigen::Vector3d from = random_point(engine, map.frame(), (i % 3 == 0 ? 10 : 60) * size_m);
      Eigen::Vector3d to = random_point(engine, map.frame(), (i % 5 == 0 ? 8 : 200) * size_m);
      if (i % 7 == 0) {
        to[i % 3] = from[i % 3];
      } else if (i % 50 == 1) {
        to = from + 0.01 * size_m * to;
      }
      const RayEnd expected = first_not_free(map, map.frame(), from, to);
      const RayEnd end = caster.cast(from, to);
      differing += end == expected ? 0U : 1U;
      ++ends[static_cast<std::size_t>(end.occupancy)];
    }
  }
  EXPECT_EQ(differing, 0U);
  EXPECT_EQ(ends[0] + ends[1] + ends[2], 10'000U * kWorlds);
  for (const std::size_t count : ends) {
    EXPECT_GT(count, 10U * kWorlds);
  }
}

// The rays of any kind of sensor, including images with unrelated neighbours.
ViewRays random_rays(std::mt19937& engine, double range_m) {
  std::uniform_real_distribution<double> angle(0.05, 2.5);
  const std::size_t width = 1 + engine() % 60;
  const std::size_t height = 1 + engine() % 40;
  switch (engine() % 4) {
    case 0:
      return ViewRays(RangeSensor::spherical(width, height, 2.5 * angle(engine), angle(engine), 0.0, range_m));
    case 1: {
      std::normal_distribution<float> unit;
      std::vector<Eigen::Vector3f> directions(width * height);
      for (Eigen::Vector3f& direction : directions) {
        direction = {unit(engine), engine() % 8 == 0 ? 0.0F : unit(engine), unit(engine) + 0.001F};
      }
      return {directions, width, height, range_m};
    }
    default:
      return ViewRays(RangeSensor::pinhole(width, height, angle(engine), angle(engine), 0.0, range_m));
  }
}

Pose random_pose(std::mt19937& engine, const VoxelFrame& frame) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Eigen::Vector3d position = random_point(engine, frame, 40 * frame.size_m);
  if (engine() % 4 == 0) {
    return pose_looking(position, static_cast<double>(engine() % 4) * 0.5 * std::acos(-1.0));
  }
  return pose_looking_along(position, {unit(engine), unit(engine), unit(engine)});
}

struct Compared {
  std::size_t rays = 0;
  std::size_t stopped = 0;
  std::size_t differing = 0;
};

void place_points(const RayTile& tile, RayBlock& block) {
  for (std::size_t i = 0; i < RayTile::kRays; ++i) {
    std::copy_n(tile.direction(i).data(), 3, &block.point[3 * i]);
  }
}

// Compares all rays of one view, cast with `set`, with slow walks to the same ends, and the cells of a box that they
// visit.
void compare_view(const OccupancyMap& map, const BlockingGrid& grid, const Pose& pose, const ViewRays& rays,
                  InstructionSet set, const std::vector<RayEnd>& expected, Compared& compared) {
  const VoxelFrame& frame = map.frame();
  const RayPlacer placer{SensorFrame(pose), rays.max_range_m(), frame.size_m * kFurthestVoxel, frame.size_m};
  SliceWalk walk(grid, frame, pose.translation(), set);
  constexpr VoxelBox kBox{{-33, -30, -31}, {29, 34, 32}};
  CellSet seen(kBox);
  CellSet expected_seen(kBox);
  CellStamps stamps(seen, set);
  for (const RayTile& tile : rays.tiles()) {
    RayBlock block;
    place_points(tile, block);
    placer.place_ends(false, block, set);
    placer.place_cells(block, set);
    TileHits hits(set);
    walk.cast(block, tile.rays, kEverywhere, 0.0, hits);
    walk.cast(block, tile.rays, kBox, 0.0, stamps);
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      if ((tile.rays >> i & 1U) == 0) {
        continue;
      }
      const bool stopped = (hits.stopped >> i & 1U) != 0;
      const auto& cells = stopped ? hits.cell : block.cell;
      const RayEnd& end = expected[tile.ray[i]];
      const bool same = end.cell == VoxelIndex{cells[0][i], cells[1][i], cells[2][i]} &&
                        stopped == (end.occupancy != Occupancy::Free);
      if (end.occupancy != Occupancy::Free) {
        expected_seen.insert(end.cell);
      }
      ++compared.rays;
      compared.stopped += stopped ? 1U : 0U;
      compared.differing += same ? 0U : 1U;
    }
  }
  compared.differing += seen == expected_seen ? 0U : 1U;
}

std::vector<RayEnd> slow_view(const OccupancyMap& map, const Pose& pose, const ViewRays& rays) {
  const RayPlacer placer{SensorFrame(pose), rays.max_range_m(), map.resolution_m() * kFurthestVoxel,
                         map.resolution_m()};
  std::vector<RayEnd> ends(rays.size());
  for (const RayTile& tile : rays.tiles()) {
    RayBlock block;
    place_points(tile, block);
    placer.place_ends(false, block, InstructionSet::Baseline);
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      ends[tile.ray[i]] =
          first_not_free(map, map.frame(), pose.translation(), {block.end[0][i], block.end[1][i], block.end[2][i]});
    }
  }
  return ends;
}

TEST(RayCaster, EveryInstructionSetFindsWhatTheSlowWalkFinds) {
  std::mt19937 engine(32);
  constexpr int kWorlds = test::kSanitized ? 30 : 100;
  std::vector<Compared> compared(instruction_sets().size());
  for (int world = 0; world < kWorlds; ++world) {
    const double size_m = world % 3 == 0 ? 0.25 : 0.07;
    const OccupancyMap map = world % 5 == 0 ? test::random_map(engine, size_m) : test::hollow_map(engine, size_m);
    BlockingGrid grid(0, CoarseningPolicy::Max);
    grid.update(map);
    const RayCaster caster(map);
    for (int view = 0; view < 12; ++view) {
      const ViewRays rays = random_rays(engine, (engine() % 8 == 0 ? 2.0 : 100.0) * size_m);
      const Pose pose = random_pose(engine, map.frame());
      const std::vector<RayEnd> expected = slow_view(map, pose, rays);
      for (std::size_t set = 0; set < compared.size(); ++set) {
        compare_view(map, grid, pose, rays, instruction_sets()[set], expected, compared[set]);
      }
      std::vector<RayEnd> ends(rays.size());
      caster.cast(pose, rays, ends);
      EXPECT_TRUE(ends == expected);
    }
  }
  for (const Compared& of_set : compared) {
    EXPECT_GT(of_set.rays, 6'000U * kWorlds);
    EXPECT_GT(of_set.stopped, 2'000U * kWorlds);
    EXPECT_GT(of_set.rays - of_set.stopped, 200U * kWorlds);
    EXPECT_EQ(of_set.differing, 0U);
  }
}

TEST(RayCaster, ARecordedMapLooksTheSameToEveryInstructionSet) {
  VANTAGE_REAL_DATA(file, "octomaps/geb079.bt");
  const OccupancyMap map = load_octomap(file).map;
  BlockingGrid grid(0, CoarseningPolicy::Max);
  grid.update(map);
  std::mt19937 engine(33);
  const Box box = map.frame().box_of(map.bounds());
  std::vector<Compared> compared(instruction_sets().size());
  while (compared[0].rays < 1'000'000) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Eigen::Vector3d share(unit(engine), unit(engine), unit(engine));
    const Eigen::Vector3d position = box.min + share.cwiseProduct(box.extent());
    if (map.at(map.frame().cell_of(position)) != Occupancy::Free) {
      continue;
    }
    const Pose pose = pose_looking(position, 6.3 * unit(engine), unit(engine) - 0.5);
    const ViewRays rays(RangeSensor::pinhole(160, 120, 1.0, 0.8, 0.0, 12.0));
    const std::vector<RayEnd> expected = slow_view(map, pose, rays);
    for (std::size_t set = 0; set < compared.size(); ++set) {
      compare_view(map, grid, pose, rays, instruction_sets()[set], expected, compared[set]);
    }
  }
  for (const Compared& of_set : compared) {
    EXPECT_GT(of_set.stopped, 500'000U);
    EXPECT_EQ(of_set.differing, 0U);
  }
}

TEST(RayCaster, FollowsTheMapAsIfMadeAnew) {
  std::mt19937 engine(34);
  std::size_t cases = 0;
  for (int world = 0; world < 20; ++world) {
    OccupancyMap map = test::random_map(engine, 0.1);
    const int level = world % 5;
    const RayCasterOptions options{level, world % 2 == 0 ? CoarseningPolicy::Max : CoarseningPolicy::Mean};
    RayCaster following(map, options);
    for (int step = 0; step < 6; ++step) {
      std::uniform_int_distribution<std::int32_t> coordinate(-150, 150);
      map.insert(test::random_scan(engine, 40));
      map.set_log_odds(VoxelBox{{-40, -40, -40}, {40, 40, 40}}, step % 2 == 0 ? -1.0 : -2.0);
      for (int i = 0; i < 30; ++i) {
        map.set({coordinate(engine), coordinate(engine), coordinate(engine)}, static_cast<Occupancy>(i % 3));
      }
      EXPECT_GT(following.update(), 0U);
      EXPECT_EQ(following.update(), 0U);
      const RayCaster anew(map, options);
      for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector3d from = random_point(engine, map.frame(), 8.0);
        const Eigen::Vector3d to = random_point(engine, map.frame(), 16.0);
        const RayEnd end = following.cast(from, to);
        ASSERT_EQ(end, anew.cast(from, to));
        ASSERT_EQ(end, first_not_free(anew, anew.frame(), from, to));
        const Occupancy state = level == 0 ? map.at(end.cell) : map.at(end.cell, level, options.policy);
        ASSERT_EQ(end.occupancy, state);
        ++cases;
      }
    }
  }
  EXPECT_EQ(cases, 240'000U);
}

TEST(RayCaster, DistancesAreThoseToTheNearestWordThatStops) {
  std::mt19937 engine(35);
  std::size_t cases = 0;
  for (int world = 0; world < 6; ++world) {
    OccupancyMap map = test::hollow_map(engine, 0.1);
    BlockingGrid grid(0, CoarseningPolicy::Max);
    for (int step = 0; step < 2; ++step) {
      map.set({static_cast<std::int32_t>(engine() % 20), 3, 3}, Occupancy::Occupied);
      grid.update(map);
      for_each_cell({{-26, -26, -26}, {26, 26, 26}}, [&](const VoxelIndex& word) {
        if (engine() % 16 != 0) {
          return;
        }
        std::int32_t nearest = BlockingGrid::kFurthest;
        for_each_cell(VoxelBox{word, word + VoxelIndex{1, 1, 1}}.grown(BlockingGrid::kFurthest - 1),
                      [&](const VoxelIndex& other) {
                        if (grid.blocking(other) != 0) {
                          const VoxelIndex by = other - word;
                          nearest = std::min(nearest, std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)}));
                        }
                      });
        ASSERT_EQ(grid.distance(word), nearest);
        ++cases;
      });
    }
  }
  EXPECT_GT(cases, 90'000U);
}

// Cells and boxes of cells change, at all distances and also in unknown space.
TEST(RayCaster, DistancesFollowTheMapAsIfFoundAnew) {
  std::mt19937 engine(37);
  std::uniform_int_distribution<std::int32_t> coordinate(-120, 120);
  std::size_t cases = 0;
  for (int world = 0; world < 4; ++world) {
    OccupancyMap map = test::hollow_map(engine, 0.1);
    BlockingGrid following(0, CoarseningPolicy::Max);
    following.update(map);
    for (int step = 0; step < 20; ++step) {
      for (std::uint32_t i = engine() % 4; i-- > 0;) {
        const VoxelIndex cell{coordinate(engine), coordinate(engine), coordinate(engine)};
        const auto edge = static_cast<std::int32_t>(engine() % 3 == 0 ? 1 : 2 + engine() % 40);
        map.set_log_odds(VoxelBox{cell, cell + VoxelIndex{edge, edge, edge}}, engine() % 3 == 0 ? 2.0 : -2.0);
      }
      following.update(map);
      BlockingGrid anew(0, CoarseningPolicy::Max);
      anew.update(map);
      std::size_t differing = 0;
      for_each_cell({{-45, -45, -45}, {45, 45, 45}}, [&](const VoxelIndex& word) {
        differing += following.distance(word) != anew.distance(word) ||
                             following.blocking(word) != anew.blocking(word) ||
                             following.occupied(word) != anew.occupied(word)
                         ? 1U
                         : 0U;
        ++cases;
      });
      ASSERT_EQ(differing, 0U);
    }
  }
  EXPECT_EQ(cases, 80U * 90U * 90U * 90U);
}

TEST(RayCaster, AViewSeesTheDistinctCellsInWhichItsRaysEnd) {
  std::mt19937 engine(36);
  constexpr int kWorlds = test::kSanitized ? 15 : 60;
  std::size_t views = 0;
  std::size_t cells = 0;
  for (int world = 0; world < kWorlds; ++world) {
    const OccupancyMap map = test::hollow_map(engine, 0.1);
    const RayCaster caster(map);
    const Eigen::Vector3d inside(0.05, -0.11, 0.13);
    std::uniform_int_distribution<std::int32_t> coordinate(-40, 20);
    for (int view = 0; view < 20; ++view) {
      const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
      const VoxelBox box{lo,
                         lo + VoxelIndex{1 + coordinate(engine) % 9 + 30, 25, 1 + static_cast<int>(engine() % 60)}};
      const RangeSensor sensor = RangeSensor::pinhole(1 + engine() % 90, 1 + engine() % 70, 1.4, 1.1,
                                                      view % 3 == 0 ? 2.0 : 0.0, view % 4 < 2 ? 2.5 : 9.0);
      const ViewRays rays(sensor);
      const Pose pose = view % 2 == 0 ? random_pose(engine, map.frame())
                                      : pose_looking_along(inside, map.frame().box_of(box).centre() - inside);
      CellSet expected(box);
      for (const RayEnd& end : slow_view(map, pose, rays)) {
        if (end.occupancy != Occupancy::Free &&
            (map.frame().centre_of(end.cell) - pose.translation()).norm() >= sensor.min_range_m) {
          expected.insert(end.cell);
        }
      }
      const CellSet seen = caster.visible_cells(pose, rays, box);
      ASSERT_TRUE(seen == expected);
      std::size_t occupied = 0;
      seen.for_each([&](const VoxelIndex& cell) { occupied += map.at(cell) == Occupancy::Occupied ? 1U : 0U; });
      EXPECT_EQ(caster.count(seen, Occupancy::Occupied), occupied);
      EXPECT_EQ(caster.count(seen, Occupancy::Unknown), seen.size() - occupied);
      ++views;
      cells += seen.size();
    }
  }
  EXPECT_EQ(views, 20U * kWorlds);
  EXPECT_GT(cells, 300U * kWorlds);
}

// Compares with a map in which the assumed states are written: the unknown cells of the box are free, except some.
TEST(RayCaster, SupposesWhatUnknownCellsHold) {
  std::mt19937 engine(91);
  std::uniform_int_distribution<std::int32_t> cell(-24, 12);
  std::size_t rays = 0;
  std::size_t unknown_ends = 0;
  for (int round = 0; round < 12; ++round) {
    OccupancyMap map = test::random_map(engine);
    RayCaster caster(map);
    for (int change = 0; change < 3; ++change) {
      const VoxelIndex lo{cell(engine), cell(engine), cell(engine)};
      CellSet stopping(VoxelBox{lo, lo + VoxelIndex{17, 9, 14}});
      OccupancyMap supposed = map;
      for_each_cell(stopping.box(), [&](const VoxelIndex& at) {
        if (map.at(at) == Occupancy::Unknown) {
          if (engine() % 7 == 0) {
            stopping.insert(at);
          } else {
            supposed.set(at, Occupancy::Free);
          }
        }
      });
      caster.suppose(stopping);
      const RayCaster expected(supposed);
      for (int i = 0; i < 200; ++i, ++rays) {
        const Eigen::Vector3d from = random_point(engine, map.frame(), 3.0);
        const Eigen::Vector3d to = map.frame().centre_of(lo + VoxelIndex{static_cast<std::int32_t>(engine() % 17),
                                                                         static_cast<std::int32_t>(engine() % 9),
                                                                         static_cast<std::int32_t>(engine() % 14)});
        const RayEnd end = caster.cast(to, from);
        EXPECT_EQ(end, expected.cast(to, from));
        unknown_ends += end.occupancy == Occupancy::Unknown ? 1U : 0U;
      }
      for_each_cell(stopping.box().grown(2),
                    [&](const VoxelIndex& at) { EXPECT_EQ(caster.at(at), expected.at(at)); });
      // A change of a cell ends its assumption; here all cells change.
      map.set_log_odds(stopping.box().grown(8), -2.0);
      caster.update();
      EXPECT_EQ(caster.at(lo), Occupancy::Free);
    }
  }
  EXPECT_EQ(rays, 7'200U);
  EXPECT_GT(unknown_ends, 1'000U);
}

TEST(RayCaster, NamesWhatIsWrong) {
  const OccupancyMap map;
  EXPECT_THROW(RayCaster(map, {.level = 17}), std::invalid_argument);
  const RayCaster caster(map);
  EXPECT_THROW((void)caster.cast({0, 0, 0}, {1e12, 0, 0}), std::invalid_argument);
  const ViewRays rays(RangeSensor::preset("vpl"));
  std::vector<RayEnd> ends(rays.size());
  Pose pose = Pose::Identity();
  caster.cast(pose, rays, ends);
  EXPECT_EQ(ends[7], (RayEnd{{0, 0, 0}, Occupancy::Unknown})) << "nothing is known: the first cell stops the ray";
  EXPECT_THROW(caster.cast(pose, rays, std::span(ends).first(3)), std::invalid_argument);
  pose.linear() *= 2.0;
  EXPECT_THROW(caster.cast(pose, rays, ends), std::invalid_argument);
  EXPECT_THROW(ViewRays({{0, 0, 1}, {0, 0, 0}}, 2, 1, 1.0), std::invalid_argument);
  EXPECT_THROW(ViewRays({{0, 0, 1}}, 2, 1, 1.0), std::invalid_argument);
  OccupancyMap wide;
  wide.set({-500'000'000, -500'000'000, -500'000'000}, Occupancy::Free);
  wide.set({500'000'000, 500'000'000, 500'000'000}, Occupancy::Free);
  EXPECT_THROW(RayCaster{wide}, std::length_error);
}

}  // namespace
}  // namespace vantage
