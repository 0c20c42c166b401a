// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/open_tour.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace vantage::detail {

using Tour = std::vector<std::size_t>;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Local searches, each from another first site.
inline constexpr std::size_t kSearches = 4;
inline constexpr std::ptrdiff_t kMovedTogether = 3;
// A tour is better if it saves more than rounding.
inline constexpr double kLeastGain = 1e-9;

// By sets of visited sites: how many there are says the position of the next one.
inline Tour exact_tour(const OpenTourProblem& problem) {
  const std::size_t n = problem.size();
  const std::size_t all = (std::size_t{1} << n) - 1;
  struct State {
    double cost = kInfinity;
    std::size_t before = 0;
  };
  std::vector<State> best((all + 1) * n);  // by visited sites, then by the last of them
  for (std::size_t visited = 1; visited <= all; ++visited) {
    const auto position = static_cast<std::size_t>(std::popcount(visited)) - 1;
    for (std::size_t last = 0; last < n; ++last) {
      if ((visited >> last & 1U) == 0) {
        continue;
      }
      const std::size_t earlier = visited ^ (std::size_t{1} << last);
      State& state = best[visited * n + last];
      if (earlier == 0) {
        state = {problem.step(n, last, 0), n};
      }
      for (std::size_t before = 0; before < n && earlier != 0; ++before) {
        const double cost = best[earlier * n + before].cost + problem.step(before, last, position);
        if ((earlier >> before & 1U) != 0 && cost < state.cost) {
          state = {cost, before};
        }
      }
    }
  }
  const auto last = std::min_element(best.end() - static_cast<std::ptrdiff_t>(n), best.end(),
                                     [](const State& a, const State& b) { return a.cost < b.cost; });
  Tour tour(n);
  auto at = static_cast<std::size_t>(last - best.end() + static_cast<std::ptrdiff_t>(n));
  std::size_t visited = all;
  for (std::size_t position = n; position-- > 0;) {
    tour[position] = at;
    const std::size_t before = best[visited * n + at].before;
    visited ^= std::size_t{1} << at;
    at = before;
  }
  return tour;
}

// Starts with `first`, then always the cheapest next step.
inline Tour greedy_tour(const OpenTourProblem& problem, std::size_t first) {
  Tour left(problem.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::swap(left[0], left[first]);
  for (std::size_t position = 1; position < left.size(); ++position) {
    const auto at = left.begin() + static_cast<std::ptrdiff_t>(position);
    std::iter_swap(at, std::min_element(at, left.end(), [&](std::size_t a, std::size_t b) {
                     return problem.step(*(at - 1), a, position) < problem.step(*(at - 1), b, position);
                   }));
  }
  return left;
}

// Takes the first change that helps, until none does.
inline void improve(const OpenTourProblem& problem, Tour& tour) {
  double cost = problem.cost(tour);
  Tour changed;
  const auto take_if_better = [&] {
    const double now = problem.cost(changed);
    if (now >= cost - kLeastGain) {
      return false;
    }
    cost = now;
    tour.swap(changed);
    return true;
  };
  const auto any_change_helps = [&] {
    const auto n = static_cast<std::ptrdiff_t>(tour.size());
    for (std::ptrdiff_t from = 0; from < n; ++from) {
      for (std::ptrdiff_t to = from + 2; to <= n; ++to) {
        changed = tour;
        std::reverse(changed.begin() + from, changed.begin() + to);
        if (take_if_better()) {
          return true;
        }
      }
      for (std::ptrdiff_t end = from + 1; end <= std::min<std::ptrdiff_t>(n, from + kMovedTogether); ++end) {
        for (std::ptrdiff_t to = end + 1; to <= n; ++to) {
          changed = tour;
          std::rotate(changed.begin() + from, changed.begin() + end, changed.begin() + to);
          if (take_if_better()) {
            return true;
          }
        }
        for (std::ptrdiff_t to = 0; to < from; ++to) {
          changed = tour;
          std::rotate(changed.begin() + to, changed.begin() + from, changed.begin() + end);
          if (take_if_better()) {
            return true;
          }
        }
      }
    }
    return false;
  };
  while (any_change_helps()) {
  }
}

VANTAGE_INLINE double OpenTourProblem::cost(const std::vector<std::size_t>& tour) const {
  double sum = 0.0;
  std::size_t before = size();
  for (std::size_t position = 0; position < tour.size(); ++position) {
    sum += step(before, tour[position], position);
    before = tour[position];
  }
  return sum;
}

VANTAGE_INLINE std::vector<std::size_t> open_tour(const OpenTourProblem& problem) {
  const std::size_t n = problem.size();
  if (n <= kExactSites) {
    return exact_tour(problem);
  }
  Tour firsts(n);
  std::iota(firsts.begin(), firsts.end(), std::size_t{0});
  std::stable_sort(firsts.begin(), firsts.end(),
                   [&](std::size_t a, std::size_t b) { return problem.step(n, a, 0) < problem.step(n, b, 0); });
  Tour best;
  double best_cost = kInfinity;
  for (std::size_t search = 0; search < kSearches; ++search) {
    Tour tour = greedy_tour(problem, firsts[search]);
    improve(problem, tour);
    if (const double cost = problem.cost(tour); cost < best_cost - kLeastGain) {
      best_cost = cost;
      best = std::move(tour);
    }
  }
  return best;
}

}  // namespace vantage::detail
