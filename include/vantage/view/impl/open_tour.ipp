// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/view/impl/open_tour.hpp>

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
inline constexpr std::size_t kMovedTogether = 3;
// A tour is better if it saves more than rounding.
inline constexpr double kLeastGain = 1e-9;

// By sets of visited sites.
inline Tour exact_tour(const OpenTourProblem& problem) {
  const std::size_t n = problem.size();
  const std::size_t all = (std::size_t{1} << n) - 1;
  struct State {
    double cost = kInfinity;
    std::size_t before = 0;
  };
  std::vector<double> unseen(all + 1, 1.0);  // by visited sites
  std::vector<State> best((all + 1) * n);    // by visited sites, then by the last of them
  for (std::size_t visited = 1; visited <= all; ++visited) {
    const auto lowest = static_cast<std::size_t>(std::countr_zero(visited));
    unseen[visited] = problem.unseen_after(lowest, unseen[visited & (visited - 1)]);
    for (std::size_t last = 0; last < n; ++last) {
      if ((visited >> last & 1U) == 0) {
        continue;
      }
      const std::size_t earlier = visited ^ (std::size_t{1} << last);
      State& state = best[visited * n + last];
      if (earlier == 0) {
        state = {problem.step(n, last, unseen[earlier]), n};
      }
      for (std::size_t before = 0; before < n && earlier != 0; ++before) {
        const double cost = best[earlier * n + before].cost + problem.step(before, last, unseen[earlier]);
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

// Starts with `first`, then always the shortest next leg.
inline Tour greedy_tour(const OpenTourProblem& problem, std::size_t first) {
  Tour left(problem.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::swap(left[0], left[first]);
  for (std::size_t position = 1; position < left.size(); ++position) {
    const auto at = left.begin() + static_cast<std::ptrdiff_t>(position);
    const double* const legs = problem.legs.data() + *(at - 1) * problem.size();
    std::iter_swap(at,
                   std::min_element(at, left.end(), [&](std::size_t a, std::size_t b) { return legs[a] < legs[b]; }));
  }
  return left;
}

// What the steps to the positions [from, to) cost.
inline double cost_between(const OpenTourProblem& problem, const Tour& tour, std::size_t from, std::size_t to) {
  double unseen = 1.0;
  double sum = 0.0;
  for (std::size_t position = 0; position < std::min(to, tour.size()); ++position) {
    if (position >= from) {
      sum += problem.step(position == 0 ? problem.size() : tour[position - 1], tour[position], unseen);
    }
    unseen = problem.unseen_after(tour[position], unseen);
  }
  return sum;
}

// Takes the first change that helps, until none does. A change permutes the sites of [from, to), so it changes the
// steps to these positions and to the one behind.
inline void improve(const OpenTourProblem& problem, Tour& tour) {
  const std::size_t n = tour.size();
  const auto at = [&](std::size_t position) { return tour.begin() + static_cast<std::ptrdiff_t>(position); };
  const auto helps = [&](std::size_t from, std::size_t to, auto&& change, auto&& undo) {
    const double before = cost_between(problem, tour, from, to + 1);
    change();
    if (cost_between(problem, tour, from, to + 1) < before - kLeastGain) {
      return true;
    }
    undo();
    return false;
  };
  const auto reversing = [&](std::size_t from, std::size_t to) {
    const auto reverse = [&] { std::reverse(at(from), at(to)); };
    return helps(from, to, reverse, reverse);
  };
  const auto exchanging = [&](std::size_t from, std::size_t middle, std::size_t to) {
    return helps(
        from, to, [&] { std::rotate(at(from), at(middle), at(to)); },
        [&] { std::rotate(at(from), at(from + to - middle), at(to)); });
  };
  const auto any_change_helps = [&] {
    for (std::size_t from = 0; from < n; ++from) {
      for (std::size_t to = from + 2; to <= n; ++to) {
        if (reversing(from, to)) {
          return true;
        }
      }
      for (std::size_t end = from + 1; end <= std::min(n, from + kMovedTogether); ++end) {
        for (std::size_t to = end + 1; to <= n; ++to) {
          if (exchanging(from, end, to)) {
            return true;
          }
        }
        for (std::size_t to = 0; to < from; ++to) {
          if (exchanging(to, from, end)) {
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
  return cost_between(*this, tour, 0, tour.size());
}

VANTAGE_INLINE std::vector<std::size_t> open_tour(const OpenTourProblem& problem) {
  const std::size_t n = problem.size();
  if (n <= kExactSites) {
    return exact_tour(problem);
  }
  Tour firsts(n);
  std::iota(firsts.begin(), firsts.end(), std::size_t{0});
  std::stable_sort(firsts.begin(), firsts.end(),
                   [&](std::size_t a, std::size_t b) { return problem.step(n, a, 1.0) < problem.step(n, b, 1.0); });
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
