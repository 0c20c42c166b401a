// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <vantage/view/impl/open_tour.hpp>

namespace vantage {
namespace {

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

}  // namespace
}  // namespace vantage
