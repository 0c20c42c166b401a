// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/view/target_view.hpp>
#include <vector>

#include <vantage/planner/impl/tour_views.hpp>

namespace vantage {
namespace {

// The most cells that a part of the frontier around a shaft of 2 x 2 x 6 m has above each other, and along it.
VoxelIndex largest_part(const RangeSensor& sensor) {
  OccupancyMap map({.resolution_m = 0.2});
  for_each_cell({{-5, -5, -15}, {5, 5, 15}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  PlannerSetup setup;
  setup.platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.1, .margin_m = 0.0});
  setup.sensor = sensor;
  Situation situation(setup);
  situation.sync(map, Pose::Identity());
  VoxelIndex largest{0, 0, 0};
  for (const detail::FrontierSite& part : detail::frontier_parts(situation, 1.0)) {
    for (const FrontierTarget& a : part.targets) {
      for (const FrontierTarget& b : part.targets) {
        const VoxelIndex apart = a.frontier - b.frontier;
        largest = {std::max(largest.x, apart.x + 1), std::max(largest.y, apart.y + 1),
                   std::max(largest.z, apart.z + 1)};
      }
    }
  }
  return largest;
}

TEST(FrontierParts, AreAsHighAsOneViewShows) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const VoxelIndex low = largest_part(RangeSensor::spherical(360, 40, 360.0 * kDegree, 10.0 * kDegree, 0.0, 4.0));
  EXPECT_LE(std::max({low.x, low.y, low.z}), 5) << "1 m";
  const VoxelIndex wide = largest_part(RangeSensor::pinhole(320, 320, 90.0 * kDegree, 90.0 * kDegree, 0.0, 3.0));
  EXPECT_LE(std::max(wide.x, wide.y), 5);
  EXPECT_GT(wide.z, 6) << "2 * 1.2 m";
  EXPECT_LE(wide.z, 12);
  const VoxelIndex sphere =
      largest_part(RangeSensor::spherical(360, 180, 360.0 * kDegree, 180.0 * kDegree, 0.0, 2.5));
  EXPECT_LE(std::max(sphere.x, sphere.y), 5);
  EXPECT_GT(sphere.z, 12) << "limited by the range: 2 * 2.29 m";
  EXPECT_LE(sphere.z, 22);
  const VoxelIndex far = largest_part(RangeSensor::preset("panoramic"));
  EXPECT_EQ(far.z, 30) << "all";
}

TEST(TourViews, SeeWhatIsSeenFromTheirPoses) {
  std::mt19937 engine(4);
  std::size_t views = 0;
  std::size_t cells = 0;
  std::size_t fewer = 0;
  std::size_t shared = 0;
  for (int seed = 0; seed < 6; ++seed) {
    OccupancyMap map({.resolution_m = 0.2});
    const std::int32_t half = 12 + 2 * seed;
    for_each_cell({{-half, -half, -3}, {half, half, 3}}, [&](const VoxelIndex& cell) {
      const bool is_wall = cell.x % 8 == 3 && cell.y % 8 != 0;
      if (engine() % 40 != 0) {
        map.set(cell, is_wall ? Occupancy::Occupied : Occupancy::Free);
      }
    });
    PlannerSetup setup;
    setup.platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.1, .margin_m = 0.0});
    setup.sensor = RangeSensor::preset("kinect");
    Situation situation(setup);
    situation.sync(map, Pose::Identity());
    std::uint64_t operations = 0;
    const VoxelIndex most{6 + seed, 6 + seed, 6 + seed};
    const std::vector<detail::FrontierSite> sites = detail::frontier_sites(situation.survey().targets, most);
    const detail::TourViews choice(situation, sites, operations);
    std::set<VoxelIndex> of_sites;
    for (const detail::FrontierSite& site : sites) {
      for (const FrontierTarget& target : site.targets) {
        of_sites.insert(target.unknown);
      }
    }
    EXPECT_TRUE(std::is_sorted(choice.unknown.begin(), choice.unknown.end(), RasterOrder{}));
    for (const detail::FrontierSite& site : sites) {  // a part of all, but of each part
      EXPECT_TRUE(std::any_of(site.targets.begin(), site.targets.end(), [&](const FrontierTarget& target) {
        return std::binary_search(choice.unknown.begin(), choice.unknown.end(), target.unknown, RasterOrder{});
      }));
    }
    fewer += choice.unknown.size() < of_sites.size() ? 1U : 0U;
    ASSERT_EQ(choice.shares.size(), choice.unknown.size());
    std::vector<double> shares(choice.unknown.size());
    for (const detail::FrontierSite& site : sites) {
      std::set<VoxelIndex> part;
      for (const FrontierTarget& target : site.targets) {
        part.insert(target.unknown);
      }
      for (std::size_t i = 0; i < shares.size(); ++i) {
        if (part.contains(choice.unknown[i])) {
          shares[i] = std::max(shares[i], 1.0 / static_cast<double>(part.size()));
        }
      }
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {  // a cell stands for others of its part that are left out
      if (choice.unknown.size() == of_sites.size()) {
        EXPECT_EQ(choice.shares[i], shares[i]);
        ++shared;
      } else {
        EXPECT_GE(choice.shares[i], shares[i]);
      }
    }
    for (const detail::TourView& view : choice.views) {
      ++views;
      EXPECT_TRUE(situation.reachable().contains(view.place));
      std::set<VoxelIndex> expected;
      for (const VoxelIndex& cell : targets_seen_from(situation.surveyed(), view.pose, operations).unknown) {
        if (std::binary_search(choice.unknown.begin(), choice.unknown.end(), cell, RasterOrder{})) {
          expected.insert(cell);
        }
      }
      std::set<VoxelIndex> seen;
      for (const std::uint32_t number : view.sees) {
        seen.insert(choice.unknown[number]);
        EXPECT_TRUE(of_sites.count(choice.unknown[number]) > 0);
      }
      EXPECT_EQ(seen, expected);
      cells += seen.size();
    }
  }
  EXPECT_GT(fewer, 0U);
  EXPECT_GT(shared, 100U);
  EXPECT_GT(views, 100U);
  EXPECT_GT(cells, 1000U);
}

}  // namespace
}  // namespace vantage
