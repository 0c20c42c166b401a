// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <random>
#include <set>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vector>

#include <vantage/planner/impl/unknown_ways.hpp>

namespace vantage {
namespace {

using detail::UnknownWays;

constexpr double kWaysCellM = 0.2;
constexpr std::int32_t kSide = 48;

VoxelBox plane() { return {{0, 0, 0}, {kSide, kSide, 1}}; }

// A plane of rooms with walls, of which a part is known.
OccupancyMap partly_known(std::mt19937& engine) {
  const VoxelFrame frame{kWaysCellM};
  OccupancyMap map({.resolution_m = kWaysCellM, .region = frame.box_of(plane())});
  const auto known_to = static_cast<std::int32_t>(16 + engine() % 24);
  const auto wall_at = static_cast<std::int32_t>(4 + engine() % 10);
  const auto door_at = static_cast<std::int32_t>(engine() % (kSide - 6));
  for_each_cell(VoxelBox{{0, 0, 0}, {known_to, kSide, 1}}, [&](const VoxelIndex& cell) {
    const bool wall = cell.x == wall_at && (cell.y < door_at || cell.y >= door_at + 6);
    map.set(cell, wall ? Occupancy::Occupied : Occupancy::Free);
  });
  return map;
}

// The mean way from all unknown cells by steps through faces, edges and corners of cells that are not occupied.
double slow_mean_m(const OccupancyMap& map, const VoxelIndex& from) {
  using Entry = std::pair<double, VoxelIndex>;
  const auto later = [](const Entry& a, const Entry& b) { return a.first > b.first; };
  std::priority_queue<Entry, std::vector<Entry>, decltype(later)> open(later);
  std::set<VoxelIndex, RasterOrder> settled;
  open.emplace(0.0, from);
  double sum_m = 0.0;
  double unknown = 0.0;
  while (!open.empty()) {
    const auto [way_m, cell] = open.top();
    open.pop();
    if (!settled.insert(cell).second) {
      continue;
    }
    if (map.at(cell) == Occupancy::Unknown) {
      sum_m += way_m;
      unknown += 1.0;
    }
    for (const VoxelIndex& step : kAllNeighbours) {
      const VoxelIndex next = cell + step;
      const bool cuts = map.at(cell + VoxelIndex{step.x, 0, 0}) == Occupancy::Occupied ||
                        map.at(cell + VoxelIndex{0, step.y, 0}) == Occupancy::Occupied;
      if (plane().contains(next) && map.at(next) != Occupancy::Occupied && !cuts) {
        open.emplace(way_m + kWaysCellM * std::sqrt(step.x * step.x + step.y * step.y), next);
      }
    }
  }
  return sum_m / unknown;
}

TEST(UnknownWays, AreAsLongAsCellByCell) {
  std::mt19937 engine(7);
  double ratios = 0.0;
  int compared = 0;
  for (int i = 0; i < 30; ++i) {
    const OccupancyMap map = partly_known(engine);
    const std::vector<VoxelIndex> places{{1, 1, 0}, {1, kSide - 2, 0}, {15, 20, 0}};
    const UnknownWays ways(map, 20.0, places);
    for (const VoxelIndex& from : places) {
      if (map.at(from) != Occupancy::Free) {
        continue;
      }
      const double ratio = ways.mean_m(from) / slow_mean_m(map, from);
      EXPECT_GT(ratio, 0.8);
      EXPECT_LT(ratio, 1.2);
      ratios += ratio;
      ++compared;
    }
  }
  EXPECT_GT(compared, 60);
  EXPECT_NEAR(ratios / compared, 1.0, 0.06);
}

TEST(UnknownWays, FollowTheKnownSpaceNotItsBox) {
  OccupancyMap map({.resolution_m = kWaysCellM});
  for (const std::int32_t at : {-6'000, 0, 6'000}) {  // 2.4 km apart
    for_each_cell(VoxelBox{{at, at, at}, {at + 8, at + 8, at + 8}},
                  [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  }
  const UnknownWays ways(map, 20.0, std::vector<VoxelIndex>{{1, 1, 1}, {-5'999, -5'999, -5'999}});
  EXPECT_GT(ways.mean_m({1, 1, 1}), 0.0);
  EXPECT_GT(ways.mean_m({-5'999, -5'999, -5'999}), 0.0);
  EXPECT_EQ(ways.mean_m({6'001, 6'001, 6'001}), 0.0) << "nobody said that it would be asked for";
  EXPECT_LE(ways.size(), 3U * 27U);
}

// However far a corridor is known, only the space around the place counts.
TEST(UnknownWays, CostNoMoreInALargerMap) {
  std::vector<std::size_t> sizes;
  std::vector<double> means_m;
  for (const std::int32_t length : {2'400, 8'000}) {
    OccupancyMap map({.resolution_m = kWaysCellM});
    map.set_log_odds(VoxelBox{{0, -1, -1}, {length, 9, 9}}, 3.5);
    map.set_log_odds(VoxelBox{{0, 0, 0}, {length, 8, 8}}, -2.0);
    const VoxelIndex place{length - 4, 4, 4};
    const UnknownWays ways(map, 5.0, std::vector<VoxelIndex>{place});
    means_m.push_back(ways.mean_m(place));
    sizes.push_back(ways.size());
  }
  EXPECT_EQ(sizes.front(), sizes.back());
  EXPECT_NEAR(means_m.front(), means_m.back(), 1e-9);
}

TEST(UnknownWays, AreNoneWhereAllIsKnown) {
  const VoxelFrame frame{kWaysCellM};
  OccupancyMap map({.resolution_m = kWaysCellM, .region = frame.box_of(plane())});
  for_each_cell(plane(), [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  EXPECT_EQ(UnknownWays(map, 5.0, std::vector<VoxelIndex>{{3, 3, 0}}).mean_m({3, 3, 0}), 0.0);
}

}  // namespace
}  // namespace vantage
