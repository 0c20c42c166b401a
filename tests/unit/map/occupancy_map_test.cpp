// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include "support/changing_map.hpp"
#include "support/compare_with_definition.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

Scan random_scan(std::mt19937& engine, std::size_t rays) {
  std::uniform_real_distribution<double> metre(-3.0, 3.0);
  Scan scan;
  scan.world_from_sensor =
      pose_looking({metre(engine), metre(engine), metre(engine)}, metre(engine), 0.3 * metre(engine));
  scan.max_range_m = 4.0;
  for (std::size_t i = 0; i < rays; ++i) {
    const Eigen::Vector3d point(metre(engine), metre(engine), metre(engine));
    (i % 5 == 0 ? scan.no_return : scan.points).push_back(point.cast<float>());
  }
  return scan;
}

TEST(OccupancyMap, KnowsNothingAtFirst) {
  const OccupancyMap map;
  EXPECT_EQ(map.at({0, 0, 0}), Occupancy::Unknown);
  EXPECT_EQ(map.revision(), 0U);
  EXPECT_TRUE(map.changed_since(0).empty());
  EXPECT_TRUE(map.bounds().empty());
}

// Compares with the history of the cell. A free cell is contested exactly if a ray has ended in it since it was last
// unknown or at the lower clamp. (The number of updates is too small for their sum to equal a whole number of
// misses.)
TEST(OccupancyMap, AFreeCellThatWasHitIsContestedUntilItIsFreeForSure) {
  std::mt19937 engine(7);
  const OccupancyMapOptions options;
  std::size_t contested = 0;
  std::size_t free = 0;
  for (int world = 0; world < 2000; ++world) {
    OccupancyMap map(options);
    double log_odds = 0.0;
    bool hit_since = false;
    for (int update = 0; update < 12; ++update) {
      const bool hit = engine() % 4 == 0;
      log_odds = std::clamp(log_odds + (hit ? options.log_odds_hit : options.log_odds_miss), options.log_odds_min,
                            options.log_odds_max);
      hit_since = hit || (hit_since && log_odds > options.log_odds_min + 1e-9);
      map.set_log_odds(VoxelIndex{1, 2, 3}, log_odds);
      const bool is_free = map.at({1, 2, 3}) == Occupancy::Free;
      EXPECT_EQ(map.contested({1, 2, 3}), is_free && hit_since) << log_odds;
      EXPECT_EQ(map.is_clear({1, 2, 3}), is_free && !hit_since) << log_odds;
      std::size_t visited = 0;
      map.for_each_clear([&](const VoxelIndex& cell) { visited += cell == VoxelIndex{1, 2, 3} ? 1U : 2U; });
      EXPECT_EQ(visited, is_free && !hit_since ? 1U : 0U);
      contested += map.contested({1, 2, 3}) ? 1U : 0U;
      free += is_free ? 1U : 0U;
    }
  }
  EXPECT_GT(contested, 3000U);
  EXPECT_GT(free - contested, 3000U);
  EXPECT_FALSE(OccupancyMap().contested({1, 2, 3}));
}

TEST(OccupancyMap, StepHoldsThePapersConstantsExactly) {
  const OccupancyMap map;
  EXPECT_DOUBLE_EQ(map.log_odds_step(), 0.05);
}

TEST(OccupancyMap, OneScanClearsTheRayAndHitsItsEnd) {
  OccupancyMap map({.resolution_m = 0.1});
  Scan scan;
  scan.world_from_sensor = pose_looking({0.05, 0.05, 0.05}, 0.0);
  scan.points = {{0.0F, 0.0F, 1.0F}};
  const ScanReport report = map.insert(scan);
  EXPECT_EQ(report.hits, 1U);
  EXPECT_EQ(report.cells_hit, 1U);
  EXPECT_EQ(report.cells_cleared, 10U);
  EXPECT_EQ(report.cells_changed, 11U);
  for (int x = 0; x < 10; ++x) {
    EXPECT_EQ(map.at({x, 0, 0}), Occupancy::Free) << x;
    EXPECT_NEAR(map.log_odds({x, 0, 0}).value(), -0.4, 1e-12);
  }
  EXPECT_EQ(map.at({10, 0, 0}), Occupancy::Occupied);
  EXPECT_NEAR(map.log_odds({10, 0, 0}).value(), 0.85, 1e-12);
}

TEST(OccupancyMap, LogOddsStayWithinTheClamps) {
  OccupancyMap map({.resolution_m = 0.1});
  Scan scan;
  scan.world_from_sensor = pose_looking({0.05, 0.05, 0.05}, 0.0);
  scan.points = {{0.0F, 0.0F, 1.0F}};
  for (int i = 0; i < 20; ++i) {
    map.insert(scan);
  }
  EXPECT_NEAR(map.log_odds({10, 0, 0}).value(), 3.5, 1e-12);
  EXPECT_NEAR(map.log_odds({3, 0, 0}).value(), -2.0, 1e-12);
}

// A depth image of a random scene: every pixel sees one of three planes, and some have no return.
Scan random_depth_image(std::mt19937& engine) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Scan scan;
  scan.width = 32;
  scan.height = 24;
  scan.world_from_sensor =
      pose_looking({2 * unit(engine), 2 * unit(engine), unit(engine)}, 3 * unit(engine), unit(engine));
  std::array<Eigen::Vector3d, 3> planes;  // n with n . p = 1
  for (Eigen::Vector3d& plane : planes) {
    plane = {0.3 * unit(engine), 0.3 * unit(engine), 0.5 + 0.3 * unit(engine)};
  }
  for (std::size_t i = 0; i < scan.width * scan.height; ++i) {
    const Eigen::Vector3d pixel((static_cast<double>(i % scan.width) - 15.5) / 26.0,
                                (static_cast<double>(i / scan.width) - 11.5) / 26.0, 1.0);
    double depth_m = 6.0;
    for (const Eigen::Vector3d& plane : planes) {
      const double inverse = plane.dot(pixel);
      depth_m = inverse > 0.0 ? std::min(depth_m, 1.0 / inverse) : depth_m;
    }
    const Eigen::Vector3f point = (pixel * depth_m).cast<float>();
    const bool is_hole = unit(engine) > 0.8;
    scan.points.push_back(is_hole ? Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()) : point);
    if (is_hole && unit(engine) > 0.5) {
      scan.no_return.push_back(pixel.cast<float>());
    }
  }
  scan.max_range_m = 4.0;
  return scan;
}

TEST(OccupancyMap, InsertUpdatesExactlyTheDefinedCells) {
  std::mt19937 engine(1);
  std::size_t cells_compared = 0;
  for (int world = 0; world < 20; ++world) {
    for (const RayPolicy policy : {RayPolicy::EveryReturn, RayPolicy::EachEndCell}) {
      cells_compared += test::compare_with_definition(random_scan(engine, 200), {.resolution_m = 0.1}, policy);
    }
  }
  EXPECT_GT(cells_compared, 50'000U);
}

TEST(OccupancyMap, InsertUpdatesExactlyTheDefinedCellsOfADepthImage) {
  std::mt19937 engine(4);
  std::size_t cells_compared = 0;
  for (int world = 0; world < 12; ++world) {
    const Scan scan = random_depth_image(engine);
    for (const RayPolicy policy : {RayPolicy::EveryReturn, RayPolicy::EachEndCell}) {
      for (const double resolution_m : {0.03, 0.1, 0.37}) {
        cells_compared += test::compare_with_definition(scan, {.resolution_m = resolution_m}, policy);
        // The region contains the sensor in about half of the worlds.
        const Box region{{-3.0, -1.5, -0.5}, {0.1, 2.0, 1.7}};
        cells_compared +=
            test::compare_with_definition(scan, {.resolution_m = resolution_m, .region = region}, policy);
      }
    }
  }
  EXPECT_GT(cells_compared, 500'000U);
}

TEST(OccupancyMap, ARayFarBeyondTheOthersIsDrawnLikeThem) {
  std::mt19937 engine(5);
  Scan scan = random_scan(engine, 50);
  scan.max_range_m = std::numeric_limits<double>::infinity();
  scan.no_return.clear();
  scan.points.push_back({300.0F, 200.0F, 400.0F});  // this return makes the window too large
  scan.points.push_back({-3.0F, -200.0F, 400.0F});
  EXPECT_GT(test::compare_with_definition(scan, {.resolution_m = 0.1}, RayPolicy::EveryReturn), 10'000U);
  EXPECT_GT(test::compare_with_definition(scan, {.resolution_m = 0.1}, RayPolicy::EachEndCell), 10'000U);
}

TEST(OccupancyMap, ChangedSinceNamesExactlyTheBricksWithAChangedState) {
  std::mt19937 engine(2);
  OccupancyMap map({.resolution_m = 0.2});
  std::vector<OccupancyMap> history{map};
  for (int step = 0; step < 12; ++step) {
    map.insert(random_scan(engine, 30));
    history.push_back(map);
  }
  std::size_t compared = 0;
  for (const OccupancyMap& then : history) {
    const std::vector<VoxelIndex> named = map.changed_since(then.revision());
    const std::set<VoxelIndex> bricks(named.begin(), named.end());
    EXPECT_EQ(bricks.size(), named.size()) << "each brick once";
    map.for_each_known([&](const VoxelIndex& cell, Occupancy occupancy) {
      ++compared;
      if (then.at(cell) != occupancy) {
        EXPECT_TRUE(bricks.contains(Brick::of_cell(cell)));
      }
    });
  }
  EXPECT_TRUE(map.changed_since(map.revision()).empty());
  EXPECT_GT(compared, 20'000U);
  EXPECT_THROW((void)map.changed_since(map.revision() + 1), std::invalid_argument);
}

TEST(OccupancyMap, BadRaysAreSkippedAndCounted) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  OccupancyMap map({.resolution_m = 0.1});
  Scan scan;
  scan.points = {{kNan, 0, 1}, {0, kInf, 1}, {0, 0, 0}, {0, 0, 1}, {0, 0, 9}, {1e30F, 0, 0}};
  scan.no_return = {{0, 0, 0}, {0, 1, 0}, {kNan, 0, 0}};
  scan.max_range_m = 5.0;
  const ScanReport report = map.insert(scan);
  EXPECT_EQ(report.not_finite, 3U);
  EXPECT_EQ(report.zero_length, 2U);
  EXPECT_EQ(report.hits, 1U);
  EXPECT_EQ(report.beyond_range, 2U);
  EXPECT_EQ(report.no_return, 1U);
  EXPECT_EQ(map.insert(Scan{}).hits, 0U);
}

TEST(OccupancyMap, AFarPoseIsAPlaceLikeAnyOther) {
  OccupancyMap map({.resolution_m = 0.1});
  Scan scan;
  scan.world_from_sensor = pose_looking({1e6, -1e6, 1e6}, 0.0);
  scan.points = {{0, 0, 1}};
  EXPECT_EQ(map.insert(scan).hits, 1U);
  EXPECT_EQ(map.counts().occupied, 1U);
  scan.world_from_sensor.translation().x() = 1e12;
  EXPECT_EQ(map.insert(scan).not_addressable, 1U);
}

TEST(OccupancyMap, RefusesAPoseThatIsNotRigidAndARangeThatIsNotPositive) {
  OccupancyMap map;
  Scan scan;
  scan.points = {{0, 0, 1}};
  scan.world_from_sensor.linear() *= 1.1;
  EXPECT_THROW(map.insert(scan), std::invalid_argument);
  scan.world_from_sensor.setIdentity();
  scan.world_from_sensor.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map.insert(scan), std::invalid_argument);
  scan.world_from_sensor.setIdentity();
  scan.max_range_m = -1.0;
  EXPECT_THROW(map.insert(scan), std::invalid_argument);
  EXPECT_EQ(map.revision(), 0U);
}

TEST(OccupancyMap, NamesTheOptionAtFault) {
  const auto message = [](const OccupancyMapOptions& options) -> std::string {
    try {
      const OccupancyMap map(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({.resolution_m = 0.0}), "OccupancyMapOptions::resolution_m is 0, must be > 0");
  EXPECT_EQ(message({.log_odds_hit = -1}), "OccupancyMapOptions::log_odds_hit is -1, must be > 0");
  EXPECT_EQ(message({.log_odds_miss = 1}), "OccupancyMapOptions::log_odds_miss is 1, must be < 0");
  EXPECT_EQ(message({.log_odds_min = 1}), "OccupancyMapOptions::log_odds_min is 1, must be < 0");
  EXPECT_EQ(message({.log_odds_max = -2}), "OccupancyMapOptions::log_odds_max is -2, must be > 0");
  EXPECT_EQ(message({.erase_range_m = 0}), "OccupancyMapOptions::erase_range_m is 0, must be > 0");
  EXPECT_NE(message({.erase_range_m = std::nan("")}).find("OccupancyMapOptions::erase_range_m"), std::string::npos);
  EXPECT_NE(message({.region = Box{}}).find("OccupancyMapOptions::region"), std::string::npos);
}

// A person stands at x = 6 m, is seen once, and goes away.
TEST(OccupancyMap, WhatHasGoneIsErasedFromNearOnly) {
  const VoxelIndex person{60, 0, 0};
  const auto looked_from = [&](const OccupancyMapOptions& options, double x_m) {
    OccupancyMap map(options);
    Scan scan;
    scan.world_from_sensor.translation() = Eigen::Vector3d(0.05, 0.05, 0.05);
    scan.points = {Eigen::Vector3f(6.0F, 0.0F, 0.0F)};
    map.insert(scan);
    EXPECT_EQ(map.at(person), Occupancy::Occupied);
    scan.world_from_sensor.translation().x() = x_m;
    scan.points = {};
    scan.no_return = {Eigen::Vector3f(1.0F, 0.0F, 0.0F)};
    scan.max_range_m = 8.0;
    for (int i = 0; i < 5; ++i) {
      map.insert(scan);
    }
    EXPECT_EQ(map.at({70, 0, 0}), Occupancy::Free) << "rays pass an occupied cell that is far away";
    EXPECT_EQ(map.log_odds({50, 0, 0}), -2.0) << "free cells are confirmed from afar";
    return map.at(person);
  };
  EXPECT_EQ(looked_from({.resolution_m = 0.1}, 2.95), Occupancy::Occupied) << "3.1 m away";
  EXPECT_EQ(looked_from({.resolution_m = 0.1}, 3.05), Occupancy::Free) << "3.0 m away";
  EXPECT_EQ(looked_from({.resolution_m = 0.1, .erase_range_m = 5.0}, 1.05), Occupancy::Free);
  EXPECT_EQ(looked_from({.resolution_m = 0.1, .erase_range_m = 1e300}, 0.05), Occupancy::Free);
  EXPECT_EQ(looked_from(OccupancyMapOptions::octomap(0.1), 0.05), Occupancy::Free);
}

TEST(OccupancyMap, KeepsToItsRegion) {
  OccupancyMap map({.resolution_m = 0.1, .region = Box{{0, 0, 0}, {0.5, 1, 1}}});
  Scan scan;
  scan.world_from_sensor = pose_looking({0.05, 0.05, 0.05}, 0.0);
  scan.points = {{0.0F, 0.0F, 1.0F}};
  map.insert(scan);
  EXPECT_EQ(map.bounds(), (VoxelBox{{0, 0, 0}, {5, 1, 1}}));
  map.set({7, 0, 0}, Occupancy::Occupied);
  EXPECT_EQ(map.at({7, 0, 0}), Occupancy::Unknown);
}

TEST(OccupancyMap, CoarserCellsSpeakForTheKnownCellsInThem) {
  std::mt19937 engine(3);
  OccupancyMap map({.resolution_m = 0.1});
  for (int i = 0; i < 5; ++i) {
    map.insert(random_scan(engine, 100));
  }
  std::size_t compared = 0;
  for (int level = 0; level <= 5; ++level) {
    const std::int32_t edge = 1 << level;
    for_each_cell({{-3, -3, -3}, {3, 3, 3}}, [&](const VoxelIndex& coarse) {
      double sum = 0;
      double largest = -1e9;
      std::size_t known = 0;
      const VoxelIndex lo{coarse.x * edge, coarse.y * edge, coarse.z * edge};
      for_each_cell({lo, lo + VoxelIndex{edge, edge, edge}}, [&](const VoxelIndex& cell) {
        if (const auto value = map.log_odds(cell)) {
          sum += *value;
          largest = std::max(largest, *value);
          ++known;
        }
      });
      const auto mean = map.log_odds(coarse, level, CoarseningPolicy::Mean);
      const auto max = map.log_odds(coarse, level, CoarseningPolicy::Max);
      ASSERT_EQ(mean.has_value(), known > 0);
      if (known > 0) {
        EXPECT_NEAR(*mean, sum / static_cast<double>(known), 1e-9);
        EXPECT_NEAR(*max, largest, 1e-9);
        ++compared;
      }
    });
  }
  EXPECT_GT(compared, 300U);
}

// The cells of these coarse cells have no address in 32 bits, or just have one.
TEST(OccupancyMap, CoarseCellsBeyondTheAddressesAreUnknown) {
  OccupancyMap map({.resolution_m = 0.1});
  map.set({0, 0, 0}, Occupancy::Occupied);
  map.set({-kFurthestVoxel, kFurthestVoxel, 0}, Occupancy::Free);
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  std::size_t compared = 0;
  for (int level = 0; level <= 16; ++level) {
    const std::int32_t beyond = 1 << (30 - level);  // the first coarse cell beyond the addresses
    EXPECT_EQ(map.at({0, 0, 0}, level, CoarseningPolicy::Max), Occupancy::Occupied);
    EXPECT_EQ(map.at({-beyond + (level == 0 ? 1 : 0), beyond - 1, 0}, level, CoarseningPolicy::Max), Occupancy::Free);
    for (const std::int32_t far : {beyond, 2 * (beyond / 2) + 1, -beyond - 1, beyond + (beyond - 1), kLeast}) {
      for (const VoxelIndex& coarse : {VoxelIndex{far, 0, 0}, VoxelIndex{0, far, 0}, VoxelIndex{0, 0, far}}) {
        EXPECT_FALSE(map.log_odds(coarse, level, CoarseningPolicy::Mean)) << level << ' ' << far;
        ++compared;
      }
    }
    if (level >= 2) {  // four times as far, where a product of 32 bits is 0 again
      EXPECT_FALSE(map.log_odds({4 * beyond, 0, 0}, level, CoarseningPolicy::Mean)) << level;
    }
  }
  EXPECT_EQ(compared, 255U);
}

TEST(OccupancyMap, AssumeFreeLeavesWhatWasMeasured) {
  OccupancyMap map({.resolution_m = 0.1});
  map.set({1, 1, 1}, Occupancy::Occupied);
  map.assume_free({{0, 0, 0}, {0.25, 0.25, 0.25}});
  EXPECT_EQ(map.at({1, 1, 1}), Occupancy::Occupied);
  EXPECT_EQ(map.counts().free, 26U);
}

TEST(OccupancyMap, IsKnownWhereverItIsMoved) {
  OccupancyMap map({.resolution_m = 0.1});
  const KnownMap known(map);
  EXPECT_TRUE(known.is_in_place(map));
  map.set({1, 2, 3}, Occupancy::Free);
  EXPECT_TRUE(known.is_in_place(map)) << "changed, it is the same";
  const OccupancyMap copy = map;
  EXPECT_FALSE(known.is(copy));
  OccupancyMap moved = std::move(map);
  EXPECT_TRUE(known.is(moved));
  EXPECT_FALSE(known.is_in_place(moved));
  EXPECT_FALSE(known.is(map)) << "moved from";  // NOLINT(bugprone-use-after-move): tested on purpose
  map = std::move(moved);
  EXPECT_TRUE(known.is_in_place(map));
  map = copy;
  EXPECT_FALSE(known.is(map)) << "written over";
  EXPECT_FALSE(KnownMap().is(map));
  std::optional<OccupancyMap> short_lived(std::in_place);
  const KnownMap gone(*short_lived);
  short_lived.reset();
  short_lived.emplace();
  EXPECT_FALSE(gone.is(*short_lived)) << "another at the same address";
}

// Rays clipped to a small region visit the same cells of it as complete rays.
TEST(OccupancyMap, ClipsRaysToItsRegion) {
  std::mt19937 engine(41);
  std::uniform_real_distribution<double> metre(-3.0, 3.0);
  std::size_t cells = 0;
  std::size_t empty = 0;
  for (int world = 0; world < 120; ++world) {
    OccupancyMapOptions options{.resolution_m = 0.1, .keep_grazed_cells = world % 3 == 0};
    const Eigen::Vector3d corner(metre(engine), metre(engine), metre(engine));
    options.region = Box{corner, corner + Eigen::Vector3d(0.35, world % 2 == 0 ? 0.8 : 0.12, 0.5)};
    for (const RayPolicy policy : {RayPolicy::EveryReturn, RayPolicy::EachEndCell}) {
      Scan scan = random_scan(engine, 400);
      if (world % 4 == 0) {
        scan.world_from_sensor.translation() = corner + Eigen::Vector3d(0.1, 0.05, 0.2);
      }
      const std::size_t known = test::compare_with_definition(scan, options, policy);
      cells += known;
      empty += known == 0 ? 1U : 0U;
    }
  }
  EXPECT_GT(cells, 3000U);
  EXPECT_GT(empty, 5U);
  EXPECT_LT(empty, 200U);
}

TEST(OccupancyMap, SurfacesAtTheEdgeOfItsRegionAreSparedByClippedRays) {
  std::mt19937 engine(43);
  std::uniform_real_distribution<double> metre(-2.0, 2.0);
  std::size_t compared = 0;
  for (const RayPolicy policy : {RayPolicy::EveryReturn, RayPolicy::EachEndCell}) {
    const OccupancyMapOptions options{
        .resolution_m = 0.1, .region = Box{{0, 0, 0}, {0.5, 0.5, 0.5}}, .keep_grazed_cells = true};
    OccupancyMap map(options);
    for (int i = 0; i < 60; ++i) {
      Scan scan = random_scan(engine, 200);
      scan.world_from_sensor.translation() = Eigen::Vector3d(metre(engine), metre(engine), metre(engine));
      const ScanCells expected = scan_cells(scan, map, policy);
      OccupancyMap slow = map;
      for (const VoxelIndex& cell : expected.hit) {
        slow.set_log_odds(cell, slow.log_odds(cell).value_or(0.0) + 0.85);
      }
      for (const VoxelIndex& cell : expected.cleared) {
        slow.set_log_odds(cell, slow.log_odds(cell).value_or(0.0) - 0.4);
      }
      map.insert(scan, policy);
      for_each_cell(*map.region(), [&](const VoxelIndex& cell) {
        ASSERT_EQ(map.log_odds(cell).has_value(), slow.log_odds(cell).has_value());
        ASSERT_NEAR(map.log_odds(cell).value_or(0.0), slow.log_odds(cell).value_or(0.0), 1e-9);
        ++compared;
      });
    }
  }
  EXPECT_EQ(compared, 2U * 60U * 125U);
}

// Each ray passes 4,000 cells, none of which is stored.
TEST(OccupancyMap, FarRaysCostNothingOutsideItsRegion) {
  OccupancyMap map({.resolution_m = 0.1, .region = Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}});
  Scan scan;
  for (int i = 0; i < 20000; ++i) {
    const float angle = 0.001F * static_cast<float>(i);
    scan.points.emplace_back(400.0F * std::cos(angle), 400.0F * std::sin(angle), 0.01F * static_cast<float>(i % 700));
  }
  for (const RayPolicy policy : {RayPolicy::EveryReturn, RayPolicy::EachEndCell}) {
    const ScanReport report = map.insert(scan, policy);
    EXPECT_EQ(report.hits, 20000U);
    EXPECT_EQ(report.cells_hit, 0U);
    EXPECT_GT(report.cells_cleared, 60U);
  }
  EXPECT_LT(map.memory_bytes(), 100'000U);
}

// Writes the same to a map in one of four ways, drawn by `kind`. Returns the number of updates that were refused.
std::size_t write_one_way(OccupancyMap& map, std::uint32_t kind, const Scan& scan, const VoxelIndex& at) {
  const std::size_t before = map.cells_refused();
  const VoxelBox box{at, at + VoxelIndex{5, 3, 9}};
  switch (kind % 4) {
    case 0: {
      const ScanReport report = map.insert(scan);
      EXPECT_EQ(report.cells_refused, map.cells_refused() - before);
      break;
    }
    case 1:
      map.set(at, kind % 3 == 0 ? Occupancy::Unknown : Occupancy::Occupied);
      break;
    case 2:
      map.set_log_odds(box, kind % 3 == 0 ? 1.0 : -1.0);
      break;
    default:
      map.assume_free(map.frame().box_of(box));
  }
  return map.cells_refused() - before;
}

// The oracle is a map without a limit, of which the limited one holds whole bricks: all of them until the limit, and
// those that it has had room for after it.
TEST(OccupancyMap, EqualsAMapWithoutALimitUntilTheLimitAndThenLosesNothing) {
  std::size_t refused = 0;
  std::size_t writes_before = 0;
  std::size_t bricks_compared = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    std::mt19937 engine(seed);
    OccupancyMapOptions options = OccupancyMapOptions::octomap(0.05);  // a brick then depends on no other brick
    OccupancyMap unlimited(options);
    options.max_bytes = 20'000 + 90'000 * seed;
    OccupancyMap map(options);
    for (int step = 0; step < 60; ++step) {
      const Scan scan = random_scan(engine, 20);
      const auto cell = [&] { return static_cast<std::int32_t>(engine() % 400) - 200; };
      const VoxelIndex at{cell(), cell(), cell()};
      const auto kind = static_cast<std::uint32_t>(engine());
      EXPECT_EQ(write_one_way(unlimited, kind, scan, at), 0U);
      refused += write_one_way(map, kind, scan, at);
      ASSERT_LE(map.memory_bytes(), options.max_bytes);
      ASSERT_EQ(map.revision(), unlimited.revision());
      const OccupancyMap::Revision since = map.revision() - engine() % 2;
      std::set<VoxelIndex> changed;
      for (const VoxelIndex& address : unlimited.changed_since(since)) {
        if (map.find_brick(address) != nullptr) {
          changed.insert(address);
        }
      }
      const std::vector<VoxelIndex> told = map.changed_since(since);
      ASSERT_EQ(std::set<VoxelIndex>(told.begin(), told.end()), changed);
      if (map.cells_refused() == 0) {
        ASSERT_EQ(map.brick_count(), unlimited.brick_count());
        ASSERT_EQ(map.bounds(), unlimited.bounds());
        ++writes_before;
      }
    }
    map.for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
      const Brick* const whole = unlimited.find_brick(address);
      ASSERT_NE(whole, nullptr);
      EXPECT_TRUE(brick.known == whole->known && brick.occupied == whole->occupied &&
                  brick.log_odds == whole->log_odds);
      ++bricks_compared;
    });
    EXPECT_LT(map.brick_count(), unlimited.brick_count());
  }
  EXPECT_GT(refused, 20'000U);
  EXPECT_GT(writes_before, 50U);
  EXPECT_GT(bricks_compared, 2'000U);
}

TEST(OccupancyMap, MovedFromIsEmptyWithTheSameOptions) {
  OccupancyMap map({.resolution_m = 0.2, .region = Box{{-9, -9, -9}, {9, 9, 9}}});
  std::mt19937 engine(8);
  map.insert(random_scan(engine, 100));
  const KnownMap known(map);
  const OccupancyMap::Counts counts = map.counts();
  const OccupancyMap taken = std::move(map);
  EXPECT_EQ(taken.counts().free, counts.free);
  EXPECT_TRUE(known.is(taken));
  EXPECT_FALSE(known.is(map));  // NOLINT(bugprone-use-after-move): tested on purpose
  EXPECT_TRUE(map.bounds().empty());
  EXPECT_EQ(map.revision(), 0U);
  EXPECT_TRUE(map.changed_since(0).empty());
  EXPECT_EQ(map.region(), taken.region());
  EXPECT_EQ(map.at({1, 1, 1}), Occupancy::Unknown);
  map.insert(random_scan(engine, 100));
  EXPECT_GT(map.counts().free, 0U);
  EXPECT_FALSE(map.changed_since(0).empty());
  EXPECT_TRUE(KnownMap(map).is(map));
  OccupancyMap assigned;
  assigned = std::move(map);
  EXPECT_GT(assigned.counts().free, 0U);
  EXPECT_EQ(map.counts().free, 0U);
}

TEST(OccupancyMap, RefusesCellsThatCannotBeAddressed) {
  OccupancyMap map({.resolution_m = 0.1});
  EXPECT_NO_THROW(map.set({kFurthestVoxel, -kFurthestVoxel, 0}, Occupancy::Free));
  EXPECT_EQ(map.at({kFurthestVoxel, -kFurthestVoxel, 0}), Occupancy::Free);
  for (const std::int32_t far : {kFurthestVoxel + 1, -kFurthestVoxel - 1, std::numeric_limits<std::int32_t>::max(),
                                 std::numeric_limits<std::int32_t>::min()}) {
    EXPECT_THROW(map.set({0, far, 0}, Occupancy::Free), std::invalid_argument) << far;
    EXPECT_THROW(map.set_log_odds(VoxelIndex{far, 0, 0}, 1.0), std::invalid_argument) << far;
  }
  EXPECT_THROW(map.assume_free({{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}}), std::invalid_argument);
  EXPECT_THROW(map.assume_free({{0, 0, 0}, {1e300, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(map.set_log_odds(VoxelBox{{-5000, -5000, -5000}, {5000, 5000, 5000}}, 1.0), std::invalid_argument);
  OccupancyMap bounded({.resolution_m = 0.1, .region = Box{{0, 0, 0}, {0.5, 0.5, 0.5}}});
  bounded.assume_free({{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}});
  EXPECT_EQ(bounded.counts().free, 125U);
}

TEST(VoxelFrame, HoldsEveryLengthWithinTheRangeOfAddresses) {
  const VoxelFrame frame{0.1};
  const double huge = 1e300;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(frame.cell_of({huge, -huge, nan}), (VoxelIndex{kFurthestVoxel, -kFurthestVoxel, -kFurthestVoxel}));
  EXPECT_EQ(frame.cell_of({0.05, -0.05, 1e8}), (VoxelIndex{0, -1, 1'000'000'000}));
  EXPECT_EQ(frame.cells_up_to(1e9), kFurthestVoxel);
  EXPECT_EQ(frame.cells_up_to(0.25), 3);
  EXPECT_EQ(frame.cells_centred_in({{-huge, 0, 0}, {huge, 1, 1}}),
            (VoxelBox{{-kFurthestVoxel, 0, 0}, {kFurthestVoxel, 10, 10}}));
}

// Compares with a search over all known cells, while cells at the border become known and unknown.
TEST(OccupancyMap, KnowsItsBoundsWhateverHappensToIt) {
  std::mt19937 engine(41);
  std::size_t shrunk = 0;
  std::size_t grown = 0;
  constexpr int kWorlds = test::kSanitized ? 4 : 8;
  for (int world = 0; world < kWorlds; ++world) {
    OccupancyMap map({.resolution_m = 0.1});
    VoxelBox last;
    for (int step = 0; step < 300; ++step) {
      change_around_origin(map, engine);
      if (engine() % 3 == 0 && !last.empty()) {  // a layer at the border is forgotten
        VoxelBox layer = last;
        (engine() % 2 == 0 ? layer.hi.x : layer.hi.z) = engine() % 2 == 0 ? last.lo.x + 1 : last.lo.z + 1;
        for_each_cell(layer, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Unknown); });
      }
      if (step == 150) {
        map = OccupancyMap(map);
      }
      std::vector<VoxelIndex> known;
      map.for_each_known([&](const VoxelIndex& cell, Occupancy /*occupancy*/) { known.push_back(cell); });
      const VoxelBox expected = detail::box_around(known);
      ASSERT_EQ(map.bounds(), expected) << "world " << world << ", step " << step;
      grown += expected.size() > last.size() ? 1U : 0U;
      shrunk += expected.size() < last.size() ? 1U : 0U;
      last = expected;
    }
  }
  EXPECT_GT(grown, 25U * kWorlds);
  EXPECT_GT(shrunk, 25U * kWorlds);
}

}  // namespace
}  // namespace vantage
