// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/map/brick_set.hpp>
#include <vector>

#include <vantage/planner/impl/block_ways.hpp>
#include <vantage/planner/impl/open_tour.hpp>
#include <vantage/view/impl/frontier_sites.hpp>

namespace vantage {
namespace {

using detail::BlockWays;
using detail::FrontierSite;
using detail::OpenTourProblem;

// Sites in a plane that show as much, or sites that show different numbers of things.
OpenTourProblem random_problem(std::size_t n, std::mt19937& engine, bool plain) {
  std::uniform_real_distribution<double> place(0.0, 10.0);
  std::vector<std::pair<double, double>> at(n + 1);
  for (auto& [x, y] : at) {
    x = place(engine);
    y = place(engine);
  }
  OpenTourProblem problem;
  for (std::size_t from = 0; from <= n; ++from) {
    for (std::size_t to = 0; to < n; ++to) {
      // asymmetric: turning costs differ by direction
      const double turn = plain ? 0.0 : 0.3 * place(engine);
      problem.legs.push_back(std::hypot(at[from].first - at[to].first, at[from].second - at[to].second) + turn);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    problem.shows.push_back(plain ? 1.0 : place(engine));
  }
  const double all = std::accumulate(problem.shows.begin(), problem.shows.end(), 0.0);
  for (double& share : problem.shows) {
    share /= all;
  }
  return problem;
}

// By the lengths after which the sites are reached.
double cost_of(const OpenTourProblem& problem, const std::vector<std::size_t>& tour) {
  double length = 0.0;
  double waited = 0.0;
  std::size_t before = problem.size();
  for (const std::size_t site : tour) {
    length += problem.legs[before * problem.size() + site];
    waited += problem.shows[site] * length;
    before = site;
  }
  return 0.5 * (length + waited);
}

double cost_of_all_orders(const OpenTourProblem& problem) {
  std::vector<std::size_t> order(problem.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  double least = std::numeric_limits<double>::infinity();
  do {
    least = std::min(least, cost_of(problem, order));
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

void expect_all_once(const std::vector<std::size_t>& tour, std::size_t n) {
  std::vector<std::size_t> sorted = tour;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_EQ(sorted[i], i);
  }
}

TEST(OpenTour, CostsAreThoseOfTheDefinition) {
  OpenTourProblem problem;
  problem.legs = {0, 3, 5, 0, 7, 2};  // 0->1: 3, 1->0: 5, start->0: 7, start->1: 2
  problem.shows = {0.75, 0.25};
  EXPECT_DOUBLE_EQ(problem.cost({0, 1}), 0.5 * (10 + 0.75 * 7 + 0.25 * 10));
  EXPECT_DOUBLE_EQ(problem.cost({1, 0}), 0.5 * (7 + 0.25 * 2 + 0.75 * 7));
  EXPECT_EQ(detail::open_tour(problem), (std::vector<std::size_t>{1, 0}));
  problem.shows = {1, 1};  // any first one shows all, so that the second leg counts half
  EXPECT_DOUBLE_EQ(problem.cost({0, 1}), 7 + 0.5 * 3);
  EXPECT_DOUBLE_EQ(problem.cost({1, 0}), 2 + 0.5 * 5);
}

// A scrap beside the robot is left for later if much waits on the other side; one on the way is not.
TEST(OpenTour, MuchThatIsFarComesBeforeAScrapThatIsADetour) {
  const auto on_a_line = [](std::vector<double> at, std::vector<double> shows) {  // from 0
    OpenTourProblem problem;
    problem.shows = std::move(shows);
    at.push_back(0.0);
    for (const double from : at) {
      for (std::size_t to = 0; to + 1 < at.size(); ++to) {
        problem.legs.push_back(std::abs(from - at[to]));
      }
    }
    return problem;
  };
  EXPECT_EQ(detail::open_tour(on_a_line({-1.0, 1.5}, {0.01, 0.99})), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(detail::open_tour(on_a_line({-1.0, 1.5}, {0.5, 0.5})), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(detail::open_tour(on_a_line({1.0, 1.5}, {0.01, 0.99})), (std::vector<std::size_t>{0, 1}));
}

TEST(OpenTour, IsTheBestOfAllOrdersOfAFewSites) {
  std::mt19937 engine(1);
  std::size_t cases = 0;
  for (std::size_t n = 1; n <= 7; ++n) {
    for (int seed = 0; seed < 40; ++seed) {
      const OpenTourProblem problem = random_problem(n, engine, seed % 2 == 0);
      const std::vector<std::size_t> tour = detail::open_tour(problem);
      expect_all_once(tour, n);
      EXPECT_NEAR(cost_of(problem, tour), cost_of_all_orders(problem), 1e-9);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 280U);
}

// The optimum over more sites than all orders allow, by sets of sites that show as much and the last of them.
double cost_by_sets(const OpenTourProblem& problem) {
  std::map<std::pair<std::set<std::size_t>, std::size_t>, double> known;
  for (std::size_t site = 0; site < problem.size(); ++site) {
    known[{{site}, site}] = problem.step(problem.size(), site, 1.0);
  }
  const auto n = static_cast<double>(problem.size());
  for (std::size_t position = 1; position < problem.size(); ++position) {
    std::map<std::pair<std::set<std::size_t>, std::size_t>, double> next;
    for (const auto& [state, cost] : known) {
      for (std::size_t site = 0; site < problem.size(); ++site) {
        if (state.first.count(site) == 0) {
          std::set<std::size_t> visited = state.first;
          visited.insert(site);
          const double reached = cost + problem.step(state.second, site, 1.0 - static_cast<double>(position) / n);
          const auto [place, is_new] = next.try_emplace({std::move(visited), site}, reached);
          place->second = std::min(place->second, reached);
        }
      }
    }
    known = std::move(next);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [state, cost] : known) {
    least = std::min(least, cost);
  }
  return least;
}

TEST(OpenTour, OverMoreSitesIsNearlyTheOptimum) {
  std::mt19937 engine(2);
  double sum = 0.0;
  double optimum = 0.0;
  for (int seed = 0; seed < 12; ++seed) {
    const OpenTourProblem problem = random_problem(detail::kExactSites + 1, engine, true);
    const std::vector<std::size_t> tour = detail::open_tour(problem);
    expect_all_once(tour, problem.size());
    const double least = cost_by_sets(problem);
    EXPECT_GE(problem.cost(tour), least - 1e-9);
    sum += problem.cost(tour);
    optimum += least;
  }
  EXPECT_LE(sum, 1.02 * optimum);
}

TEST(OpenTour, OfManySitesVisitsEachOnce) {
  std::mt19937 engine(3);
  for (const std::size_t n : {24U, 60U}) {
    const OpenTourProblem problem = random_problem(n, engine, false);
    expect_all_once(detail::open_tour(problem), n);
  }
}

// --- lengths of ways

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
  BrickSet set;
  for (const VoxelIndex& cell : cells) {
    set.insert(cell);
  }
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

TEST(BlockWays, DoNotLeakThroughWallsAndAreAboutAsLongAsThoseOverCells) {
  std::mt19937 engine(5);
  std::size_t joined = 0;
  std::size_t apart = 0;
  double sum = 0.0;
  double fine_sum = 0.0;
  for (int seed = 0; seed < 12; ++seed) {
    const std::set<VoxelIndex> cells = random_rooms(engine, seed % 2 == 0 ? 1 : 7);
    const std::vector<VoxelIndex> list(cells.begin(), cells.end());
    const BlockWays ways = ways_of(cells, seed % 4 < 2 ? 4 : 8);
    const VoxelIndex from = list[engine() % list.size()];
    const std::vector<double> lengths = ways.lengths_from(from);
    const std::map<VoxelIndex, double> fine = fine_lengths(cells, from);
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

// --- sites

TEST(FrontierSites, HoldEveryTargetOnceAndAreNoLargerThanAllowed) {
  std::mt19937 engine(7);
  std::size_t sites_seen = 0;
  for (int seed = 0; seed < 20; ++seed) {
    std::set<VoxelIndex> cells;
    VoxelIndex walk{0, 0, 0};
    for (int i = 0; i < 300; ++i) {
      walk = walk + kAllNeighbours[engine() % 26];
      cells.insert(walk);
      walk = engine() % 60 == 0 ? walk + VoxelIndex{9, -4, 0} : walk;
    }
    std::vector<VoxelIndex> sorted(cells.begin(), cells.end());
    std::sort(sorted.begin(), sorted.end(), RasterOrder{});
    std::vector<FrontierTarget> targets;
    for (const VoxelIndex& cell : sorted) {
      targets.push_back({cell, cell + VoxelIndex{1, 0, 0}, cell});
    }
    const std::int32_t most = 3 + seed % 6;
    std::set<VoxelIndex> held;
    for (const FrontierSite& site : detail::frontier_sites(targets, most)) {
      ++sites_seen;
      bool holds_middle = false;
      for (const FrontierTarget& a : site.targets) {
        EXPECT_TRUE(held.insert(a.frontier).second);
        holds_middle = holds_middle || a.frontier == site.middle.frontier;
        for (const FrontierTarget& b : site.targets) {
          const VoxelIndex apart = a.frontier - b.frontier;
          EXPECT_LT(std::max({apart.x, apart.y, apart.z}), most);
        }
      }
      EXPECT_TRUE(holds_middle);
    }
    EXPECT_EQ(held, cells);
  }
  EXPECT_GT(sites_seen, 100U);
}

TEST(FrontierSites, APartThatIsSmallEnoughIsNotDividedAndItsMiddleIsInTheMiddle) {
  std::vector<FrontierTarget> targets;
  for (std::int32_t x = 0; x < 7; ++x) {
    targets.push_back({{x, 0, 0}, {x, 1, 0}, {x, -1, 0}});
  }
  const std::vector<FrontierSite> whole = detail::frontier_sites(targets, 7);
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole.front().middle.frontier, (VoxelIndex{3, 0, 0}));
  EXPECT_EQ(detail::frontier_sites(targets, 6).size(), 2U);
  EXPECT_TRUE(detail::frontier_sites({}, 6).empty());
}

}  // namespace
}  // namespace vantage
