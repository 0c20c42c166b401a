// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <utility>
#include <vantage/map/brick_set.hpp>
#include <vector>

#include <vantage/robot/impl/block_ways.hpp>

namespace vantage {
namespace {

using detail::BlockWays;

constexpr double kCellM = 0.2;

// A random set of cells in a box, with walls one cell thick that have few gaps.
std::set<VoxelIndex> random_rooms(std::mt19937& engine, std::int32_t height) {
  std::set<VoxelIndex> cells;
  std::set<std::int32_t> walls_x;
  std::set<std::int32_t> walls_y;
  for (int i = 0; i < 4; ++i) {
    walls_x.insert(static_cast<std::int32_t>(engine() % 60) - 20);
    walls_y.insert(static_cast<std::int32_t>(engine() % 40) - 10);
  }
  std::bernoulli_distribution gap(0.06);
  for_each_cell({{-20, -10, 0}, {40, 30, height}}, [&](const VoxelIndex& cell) {
    const bool in_wall = walls_x.count(cell.x) > 0 || walls_y.count(cell.y) > 0;
    if (!in_wall || gap(engine)) {
      cells.insert(cell);
    }
  });
  return cells;
}

// Leads through these cells from now on.
void follow(BlockWays& ways, const std::set<VoxelIndex>& cells) {
  BrickSet set(std::vector<VoxelIndex>(cells.begin(), cells.end()));
  ways.follow([set = std::move(set)](const VoxelIndex& brick) {
    const BrickPlane* const plane = set.find(brick);
    return plane == nullptr ? BrickPlane{} : *plane;
  });
}

BlockWays ways_of(const std::set<VoxelIndex>& cells, std::int32_t side) {
  BlockWays ways(VoxelFrame{kCellM}, side);
  follow(ways, cells);
  return ways;
}

// Through faces, edges and corners of cells, around corners only where both sides are free.
std::map<VoxelIndex, double> fine_lengths(const std::set<VoxelIndex>& cells, const VoxelIndex& from) {
  std::map<VoxelIndex, double> lengths{{from, 0.0}};
  using Entry = std::pair<double, VoxelIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto [length, cell] = open.top();
    open.pop();
    if (length > lengths.at(cell)) {
      continue;
    }
    for (const VoxelIndex& step : kAllNeighbours) {
      bool free = true;
      for (int part = 1; part < 8; ++part) {
        free = free && cells.count(cell + VoxelIndex{(part & 1) != 0 ? step.x : 0, (part & 2) != 0 ? step.y : 0,
                                                     (part & 4) != 0 ? step.z : 0}) > 0;
      }
      const double reached = length + kCellM * Eigen::Vector3d(step.x, step.y, step.z).norm();
      const auto known = lengths.find(cell + step);
      if (free && (known == lengths.end() || reached < known->second - 1e-9)) {
        lengths[cell + step] = reached;
        open.emplace(reached, cell + step);
      }
    }
  }
  return lengths;
}

// Ways through random rooms, in a plane or not, on blocks of either size, and the lengths from one cell as they are.
struct RoomsWithWays {
  RoomsWithWays(std::mt19937& engine, int seed)
      : cells(random_rooms(engine, seed % 2 == 0 ? 1 : 7)),
        list(cells.begin(), cells.end()),
        side(seed % 4 < 2 ? 4 : 8),
        ways(ways_of(cells, side)),
        from(list[engine() % list.size()]),
        fine(fine_lengths(cells, from)) {}

  std::set<VoxelIndex> cells;
  std::vector<VoxelIndex> list;
  std::int32_t side;
  BlockWays ways;
  VoxelIndex from;
  std::map<VoxelIndex, double> fine;
};

TEST(BlockWays, DoNotLeakThroughWallsAndAreAboutAsLongAsThoseOverCells) {
  std::mt19937 engine(5);
  std::size_t joined = 0;
  std::size_t apart = 0;
  double sum = 0.0;
  double fine_sum = 0.0;
  for (int seed = 0; seed < 12; ++seed) {
    const auto [cells, list, side, ways, from, fine] = RoomsWithWays(engine, seed);
    const std::vector<double> lengths = ways.lengths_from(from);
    for (int i = 0; i < 50; ++i) {
      const VoxelIndex to = list[engine() % list.size()];
      const double length = ways.length_to(to, from, lengths);
      const auto exact = fine.find(to);
      ASSERT_EQ(length == BlockWays::kNoWay, exact == fine.end());
      if (exact == fine.end()) {
        ++apart;
        continue;
      }
      ++joined;
      const double straight = (VoxelFrame{kCellM}.centre_of(to) - VoxelFrame{kCellM}.centre_of(from)).norm();
      EXPECT_GE(length, straight - 1e-9);
      EXPECT_LE(std::abs(length - exact->second), 0.35 * exact->second + 2.5);
      sum += length;
      fine_sum += exact->second;
    }
  }
  EXPECT_GT(joined, 200U);
  EXPECT_GT(apart, 20U);
  EXPECT_NEAR(sum / fine_sum, 1.0, 0.12);
}

// A search that ends early finds the nearest of the wanted cells, in the order and with the lengths of a full one.
TEST(BlockWays, ThatEndAtTheNearestAreAsLongAsAll) {
  std::mt19937 engine(11);
  std::size_t compared = 0;
  std::size_t left_out = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const std::set<VoxelIndex> cells = random_rooms(engine, seed % 2 == 0 ? 1 : 7);
    const std::vector<VoxelIndex> list(cells.begin(), cells.end());
    const std::int32_t side = seed % 4 < 3 ? 4 : 8;
    const BlockWays ways = ways_of(cells, side);
    const BlockWays bounded_ways = ways_of(cells, side);
    const VoxelIndex from = list[engine() % list.size()];
    std::vector<VoxelIndex> wanted;
    for (int i = 0; i < 30; ++i) {
      wanted.push_back(list[engine() % list.size()]);
    }
    const std::size_t most = 1 + engine() % 6;
    const std::vector<double> lengths = ways.lengths_from(from);
    const std::vector<double> bounded = bounded_ways.lengths_from(from, wanted, most);
    std::vector<double> all;
    std::vector<double> found;
    for (const VoxelIndex& cell : wanted) {
      all.push_back(ways.length_to(cell, from, lengths));
      found.push_back(bounded_ways.length_to(cell, from, bounded));
      left_out += found.back() == BlockWays::kNoWay && all.back() != BlockWays::kNoWay ? 1U : 0U;
    }
    std::sort(all.begin(), all.end());
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < most; ++i, ++compared) {
      ASSERT_EQ(found[i], all[i]);
    }
  }
  EXPECT_GT(compared, 100U);
  EXPECT_GT(left_out, 100U);
}

// Ways that were kept while the set changed here and there are those of the set as it is.
TEST(BlockWays, ThatWereKeptAreAsLongAsNewOnes) {
  std::mt19937 engine(13);
  std::size_t compared = 0;
  std::size_t changed = 0;
  for (int seed = 0; seed < 12; ++seed) {
    std::set<VoxelIndex> cells = random_rooms(engine, seed % 2 == 0 ? 1 : 7);
    const std::int32_t side = seed % 4 < 2 ? 4 : 8;
    BlockWays kept(VoxelFrame{kCellM}, side);
    std::vector<double> before;
    for (int change = 0; change < 6; ++change) {
      const VoxelIndex lo{static_cast<std::int32_t>(engine() % 60) - 20,
                          static_cast<std::int32_t>(engine() % 40) - 10, 0};
      const bool fill = engine() % 2 == 0;
      for_each_cell({lo, lo + VoxelIndex{3, 3, 7}}, [&](const VoxelIndex& cell) {
        if (fill) {
          cells.insert(cell);
        } else {
          cells.erase(cell);
        }
      });
      follow(kept, cells);
      const BlockWays anew = ways_of(cells, side);
      const std::vector<VoxelIndex> list(cells.begin(), cells.end());
      const VoxelIndex from = list[engine() % list.size()];
      const std::vector<double> lengths = kept.lengths_from(from);
      const std::vector<double> expected = anew.lengths_from(from);
      for (int i = 0; i < 40; ++i, ++compared) {
        const VoxelIndex to = list[engine() % list.size()];
        ASSERT_EQ(kept.length_to(to, from, lengths), anew.length_to(to, from, expected));
      }
      EXPECT_EQ(std::count_if(lengths.begin(), lengths.end(), [](double m) { return m != BlockWays::kNoWay; }),
                std::count_if(expected.begin(), expected.end(), [](double m) { return m != BlockWays::kNoWay; }));
      changed += lengths != before ? 1U : 0U;
      before = lengths;
    }
  }
  EXPECT_EQ(compared, 12U * 6U * 40U);
  EXPECT_GT(changed, 60U);
}

TEST(BlockWays, KnowNoWayToOrFromACellOutside) {
  const BlockWays ways = ways_of({{0, 0, 0}, {1, 0, 0}}, 4);
  EXPECT_EQ(ways.piece_of({9, 0, 0}), BlockWays::kNone);
  const std::vector<double> lengths = ways.lengths_from({0, 0, 0});
  EXPECT_EQ(ways.length_to({9, 0, 0}, {0, 0, 0}, lengths), BlockWays::kNoWay);
  EXPECT_NEAR(ways.length_to({1, 0, 0}, {0, 0, 0}, lengths), kCellM, 1e-12);
  EXPECT_EQ(ways.length_to({0, 0, 0}, {9, 0, 0}, ways.lengths_from({9, 0, 0})), BlockWays::kNoWay);
}

TEST(BlockWays, LeadFromBlockToBlockWhereOneLeadsOverCells) {
  std::mt19937 engine(17);
  const VoxelFrame frame{kCellM};
  std::size_t joined = 0;
  std::size_t apart = 0;
  double sum = 0.0;
  double fine_sum = 0.0;
  for (int seed = 0; seed < 16; ++seed) {
    const auto [cells, list, side, ways, from, fine] = RoomsWithWays(engine, seed);
    for (int i = 0; i < 50; ++i) {
      const VoxelIndex to = i == 0 ? from : list[engine() % list.size()];
      const std::vector<VoxelIndex> way = ways.way(from, to);
      ASSERT_EQ(way.empty(), fine.count(to) == 0);
      if (way.empty()) {
        ++apart;
        continue;
      }
      ++joined;
      EXPECT_EQ(way.front(), from);
      EXPECT_EQ(way.back(), to);
      for (std::size_t at = 1; at < way.size(); ++at) {
        EXPECT_EQ(cells.count(way[at]), 1U);
        const VoxelIndex step = way[at] - way[at - 1];
        EXPECT_LT(std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)}), 2 * side);
        sum += (frame.centre_of(way[at]) - frame.centre_of(way[at - 1])).norm();
      }
      fine_sum += fine.at(to);
    }
  }
  EXPECT_GT(joined, 300U);
  EXPECT_GT(apart, 20U);
  EXPECT_NEAR(sum / fine_sum, 1.0, 0.15);
}

TEST(BlockWays, LeadNowhereOutside) {
  const BlockWays ways = ways_of({{0, 0, 0}, {1, 0, 0}}, 4);
  EXPECT_TRUE(ways.way({9, 0, 0}, {0, 0, 0}).empty());
  EXPECT_TRUE(ways.way({0, 0, 0}, {9, 0, 0}).empty());
}

}  // namespace
}  // namespace vantage
