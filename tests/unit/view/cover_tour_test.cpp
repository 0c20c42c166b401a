// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <vantage/view/impl/cover_tour.hpp>

namespace vantage {
namespace {

using detail::CoverTourProblem;

// Views in a plane that see the things within 2.5 m.
CoverTourProblem random_views(std::size_t views, std::size_t things, std::mt19937& engine) {
  std::uniform_real_distribution<double> place(0.0, 8.0);
  std::vector<std::pair<double, double>> at(views + 1);
  for (auto& [x, y] : at) {
    x = place(engine);
    y = place(engine);
  }
  CoverTourProblem problem;
  problem.per_view = 0.7;
  problem.leg = [at](std::size_t from, std::size_t to) {
    return std::hypot(at[from].first - at[to].first, at[from].second - at[to].second);
  };
  problem.sees.resize(views);
  for (std::uint32_t thing = 0; thing < things; ++thing) {
    const double x = place(engine);
    const double y = place(engine);
    for (std::size_t view = 0; view < views; ++view) {
      if (std::hypot(at[view].first - x, at[view].second - y) < 2.5) {
        problem.sees[view].push_back(thing);
      }
    }
  }
  return problem;
}

std::set<std::uint32_t> seen_by(const CoverTourProblem& problem, const std::vector<std::size_t>& views) {
  std::set<std::uint32_t> seen;
  for (const std::size_t view : views) {
    seen.insert(problem.sees[view].begin(), problem.sees[view].end());
  }
  return seen;
}

std::vector<std::size_t> all_views(const CoverTourProblem& problem) {
  std::vector<std::size_t> views(problem.size());
  std::iota(views.begin(), views.end(), std::size_t{0});
  return views;
}

double cost_of(const CoverTourProblem& problem, const std::vector<std::size_t>& tour) {
  double cost = 0.0;
  std::size_t before = problem.size();
  for (const std::size_t view : tour) {
    cost += problem.per_view + problem.leg(before, view);
    before = view;
  }
  return cost;
}

// Over all sets of views that see everything, in all orders.
double least_cost(const CoverTourProblem& problem) {
  const std::set<std::uint32_t> all = seen_by(problem, all_views(problem));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t set = 1; set < std::size_t{1} << problem.size(); ++set) {
    std::vector<std::size_t> tour;
    for (std::size_t view = 0; view < problem.size(); ++view) {
      if ((set >> view & 1U) != 0) {
        tour.push_back(view);
      }
    }
    if (seen_by(problem, tour) != all) {
      continue;
    }
    do {
      least = std::min(least, cost_of(problem, tour));
    } while (std::next_permutation(tour.begin(), tour.end()));
  }
  return least;
}

TEST(CoverTour, SeesAllThatCanBeSeenAndNoViewIsInVain) {
  std::mt19937 engine(1);
  std::size_t views = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const CoverTourProblem problem = random_views(5 + static_cast<std::size_t>(seed % 40), 60, engine);
    const std::vector<std::size_t> tour = detail::cover_tour(problem, problem.size());
    const std::set<std::uint32_t> all = seen_by(problem, all_views(problem));
    EXPECT_EQ(seen_by(problem, tour), all);
    for (const std::size_t view : tour) {
      std::vector<std::size_t> others = tour;
      std::erase(others, view);
      EXPECT_LT(seen_by(problem, others).size(), all.size());
      ++views;
    }
    EXPECT_LE(detail::cover_tour(problem, 2).size(), 2U);
  }
  EXPECT_GT(views, 200U);
}

TEST(CoverTour, CostsLittleMoreThanTheBestOfAllSetsInAllOrders) {
  std::mt19937 engine(2);
  double sum = 0.0;
  double least_sum = 0.0;
  for (int seed = 0; seed < 40; ++seed) {
    const CoverTourProblem problem = random_views(7, 25, engine);
    const double cost = cost_of(problem, detail::cover_tour(problem, 7));
    const double least = least_cost(problem);
    EXPECT_GE(cost, least - 1e-9);
    sum += cost;
    least_sum += least;
  }
  EXPECT_LE(sum, 1.15 * least_sum);
}

TEST(CoverTour, TakesTheViewOnTheWayAndNotTheOneAside) {
  CoverTourProblem problem;
  problem.per_view = 1.0;
  problem.sees = {{0, 1, 2, 3}, {4}, {4}};
  const std::vector<double> x{4.0, 2.0, -2.0, 0.0};  // of the views, then of the start
  problem.leg = [&](std::size_t from, std::size_t to) { return std::abs(x[from] - x[to]); };
  EXPECT_EQ(detail::cover_tour(problem, 9), (std::vector<std::size_t>{1, 0}));
}

// All ways through the layers; the rest of the tour stays.
double least_refined(const CoverTourProblem& problem, std::vector<std::size_t> tour,
                     const std::vector<std::vector<std::size_t>>& serving, std::size_t layer) {
  if (layer == serving.size()) {
    return cost_of(problem, tour);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t view : serving[layer]) {
    tour[layer] = view;
    least = std::min(least, least_refined(problem, tour, serving, layer + 1));
  }
  return least;
}

TEST(RefinedTour, IsTheBestOfAllReplacements) {
  std::mt19937 engine(3);
  std::size_t better = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const CoverTourProblem problem = random_views(60, 12, engine);
    const std::vector<std::size_t> tour = detail::cover_tour(problem, 60);
    const std::size_t layers = std::min(tour.size(), static_cast<std::size_t>(seed % 4));
    std::vector<std::vector<std::size_t>> serving(layers);
    for (std::size_t layer = 0; layer < layers; ++layer) {
      std::vector<std::size_t> others = tour;
      std::erase(others, tour[layer]);
      const std::set<std::uint32_t> seen_by_others = seen_by(problem, others);
      const auto& replaced = problem.sees[tour[layer]];
      for (const std::size_t view : all_views(problem)) {
        const auto& sees = problem.sees[view];
        std::size_t own = 0;
        std::size_t common = 0;
        for (const std::uint32_t thing : replaced) {
          const bool is_own = seen_by_others.count(thing) == 0;
          own += is_own ? 1U : 0U;
          common += is_own && std::count(sees.begin(), sees.end(), thing) > 0 ? 1U : 0U;
        }
        if (10 * common >= 9 * own && 10 * sees.size() >= 9 * replaced.size()) {
          serving[layer].push_back(view);
        }
      }
    }
    const std::vector<std::size_t> refined = detail::refined_tour(problem, tour, static_cast<std::size_t>(seed % 4));
    ASSERT_EQ(refined.size(), tour.size());
    EXPECT_TRUE(std::equal(refined.begin() + static_cast<std::ptrdiff_t>(layers), refined.end(),
                           tour.begin() + static_cast<std::ptrdiff_t>(layers)));
    EXPECT_NEAR(cost_of(problem, refined), least_refined(problem, tour, serving, 0), 1e-9);
    better += cost_of(problem, refined) < cost_of(problem, tour) - 1e-9 ? 1U : 0U;
  }
  EXPECT_GT(better, 10U);
}

}  // namespace
}  // namespace vantage
