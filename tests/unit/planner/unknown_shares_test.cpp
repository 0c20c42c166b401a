// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/planner/impl/unknown_shares.hpp>

namespace vantage {
namespace {

constexpr double kSharesCellM = 0.2;

// Cell by cell; each belongs to the place nearest to the centre of its brick.
std::vector<double> slow_shares(const OccupancyMap& map, const VoxelBox& region, double seen_m,
                                const std::vector<VoxelIndex>& places) {
  const VoxelFrame frame{kSharesCellM};
  std::vector<double> shares(places.size(), 0.0);
  double unknown = 0.0;
  for_each_cell(region, [&](const VoxelIndex& cell) {
    if (map.at(cell) != Occupancy::Unknown) {
      return;
    }
    const Eigen::Vector3d at_m = VoxelFrame{Brick::kSide * kSharesCellM}.centre_of(Brick::of_cell(cell));
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (const double squared = (frame.centre_of(places[i]) - at_m).squaredNorm(); squared < least) {
        least = squared;
        nearest = i;
      }
    }
    shares[nearest] += std::sqrt(least) > seen_m ? 1.0 : 0.0;
    unknown += 1.0;
  });
  for (double& share : shares) {
    share = unknown > 0.0 ? share / unknown : 0.0;
  }
  return shares;
}

TEST(UnknownShares, AreThoseCellByCell) {
  std::mt19937 engine(7);
  std::size_t positive = 0;
  for (int i = 0; i < 30; ++i) {
    const auto side = static_cast<std::int32_t>(30 + engine() % 30);
    const VoxelBox region{{-5, 3, -7}, {side, side + 4, 9}};
    OccupancyMap map({.resolution_m = kSharesCellM, .region = VoxelFrame{kSharesCellM}.box_of(region)});
    const auto known_to = static_cast<std::int32_t>(engine() % 30);
    for_each_cell({{-5, 3, -7}, {known_to, side, 4}}, [&](const VoxelIndex& cell) {
      if (engine() % 8 != 0) {
        map.set(cell, engine() % 4 == 0 ? Occupancy::Occupied : Occupancy::Free);
      }
    });
    std::vector<VoxelIndex> places;
    for (int place = 0; place < 1 + i % 6; ++place) {
      places.push_back({static_cast<std::int32_t>(engine() % 40), static_cast<std::int32_t>(engine() % 40),
                        static_cast<std::int32_t>(engine() % 8)});
    }
    for (const auto& [beyond_m, seen_m] : {std::pair(12.0, 0.0), std::pair(2.0, 2.0), std::pair(2.0, 0.5)}) {
      const VoxelBox box = detail::box_overlap(map.bounds().grown(map.frame().cells_up_to(beyond_m)), region);
      const VoxelIndex behind = Brick::of_cell(box.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1};
      const VoxelBox bricks{Brick::first_cell(Brick::of_cell(box.lo)), Brick::first_cell(behind)};
      const VoxelBox counted = detail::box_overlap(bricks, region);
      const std::vector<double> shares = detail::unknown_shares(map, beyond_m, seen_m, places);
      const std::vector<double> expected = slow_shares(map, counted, seen_m, places);
      ASSERT_EQ(shares.size(), places.size());
      for (std::size_t place = 0; place < places.size(); ++place) {
        EXPECT_NEAR(shares[place], expected[place], 1e-12);
        positive += shares[place] > 0.0 ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(positive, 40U);
}

TEST(UnknownShares, AreNoneWhereAllIsKnownOrSeen) {
  const VoxelBox region{{0, 0, 0}, {16, 16, 8}};
  OccupancyMap map({.resolution_m = kSharesCellM, .region = VoxelFrame{kSharesCellM}.box_of(region)});
  map.set({0, 0, 0}, Occupancy::Free);
  map.set({15, 15, 7}, Occupancy::Free);
  const std::vector<VoxelIndex> place{{3, 3, 3}};
  EXPECT_EQ(detail::unknown_shares(map, 5.0, 5.0, place), std::vector<double>{0.0});
  EXPECT_GT(detail::unknown_shares(map, 1.0, 0.0, place).front(), 0.9);
  for_each_cell(region, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  EXPECT_EQ(detail::unknown_shares(map, 1.0, 0.0, place), std::vector<double>{0.0});
}

// However far apart the known cells are, the number of bricks that are looked at is bounded.
TEST(UnknownShares, EndInALargeMap) {
  OccupancyMap map({.resolution_m = kSharesCellM});
  for (const std::int32_t at : {-6'000, 0, 6'000}) {  // 2.4 km apart
    map.set({at, at, at}, Occupancy::Free);
  }
  const std::vector<VoxelIndex> places{{1, 1, 1}, {-5'999, -5'999, -5'999}};
  const std::vector<double> shares = detail::unknown_shares(map, 20.0, 0.0, places);
  EXPECT_GT(shares.front(), 0.1);
  EXPECT_GT(shares.back(), 0.1);
  EXPECT_NEAR(shares.front() + shares.back(), 1.0, 1e-12);
}

}  // namespace
}  // namespace vantage
