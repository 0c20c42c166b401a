// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/view/impl/cover_tour.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace vantage::detail {

// How much of what a view shows another must show to take its place.
inline constexpr double kNearlyAll = 0.9;

// How many views of a tour show each thing.
class Shown {
 public:
  Shown(const CoverTourProblem& problem, const std::vector<std::size_t>& tour) : problem_(problem) {
    std::uint32_t things = 0;
    for (const std::vector<std::uint32_t>& seen : problem.sees) {
      things = seen.empty() ? things : std::max(things, seen.back() + 1);
    }
    times_.resize(things);
    for (const std::size_t view : tour) {
      count(view, 1);
    }
  }
  void count(std::size_t view, int by) {
    for (const std::uint32_t thing : problem_.sees[view]) {
      times_[thing] += by;
    }
  }
  // How many things a view shows that no view of the tour shows.
  [[nodiscard]] std::size_t new_in(std::size_t view) const {
    const std::vector<std::uint32_t>& sees = problem_.sees[view];
    return static_cast<std::size_t>(
        std::count_if(sees.begin(), sees.end(), [&](std::uint32_t thing) { return times_[thing] == 0; }));
  }
  // The things that a view of the tour alone shows.
  [[nodiscard]] std::vector<std::uint32_t> only_by(std::size_t view) const {
    std::vector<std::uint32_t> things;
    for (const std::uint32_t thing : problem_.sees[view]) {
      if (times_[thing] == 1) {
        things.push_back(thing);
      }
    }
    return things;
  }

 private:
  const CoverTourProblem& problem_;
  std::vector<int> times_;
};

// The place in a tour where a view adds least, and what it adds. `legs`: from the start and from each view of the
// tour to every view.
inline std::pair<std::size_t, double> cheapest_place(const std::vector<std::size_t>& tour,
                                                     const std::vector<std::vector<double>>& legs, std::size_t view) {
  std::pair<std::size_t, double> best{tour.size(), legs[tour.size()][view]};
  for (std::size_t at = 0; at < tour.size(); ++at) {
    const double onward = legs[at + 1][view];  // as long as back
    const double added = std::max(0.0, legs[at][view] + onward - legs[at][tour[at]]);
    if (added < best.second) {
      best = {at, added};
    }
  }
  return best;
}

VANTAGE_INLINE std::vector<std::size_t> cover_tour(const CoverTourProblem& problem, std::size_t most_views) {
  const auto legs_from = [&](std::size_t from) {
    std::vector<double> legs(problem.size());
    for (std::size_t to = 0; to < legs.size(); ++to) {
      legs[to] = problem.leg(from, to);
    }
    return legs;
  };
  std::vector<std::size_t> tour;
  std::vector<std::vector<double>> legs{legs_from(problem.size())};
  Shown shown(problem, tour);
  while (tour.size() < most_views) {
    double best_rate = 0.0;
    std::size_t best = 0;
    std::size_t best_at = 0;
    for (std::size_t view = 0; view < problem.size(); ++view) {
      const std::size_t gain = shown.new_in(view);
      if (gain > 0) {
        const auto [at, added] = cheapest_place(tour, legs, view);
        if (const double rate = static_cast<double>(gain) / (problem.per_view + added); rate > best_rate) {
          best_rate = rate;
          best = view;
          best_at = at;
        }
      }
    }
    if (best_rate == 0.0) {
      break;
    }
    shown.count(best, 1);
    tour.insert(tour.begin() + static_cast<std::ptrdiff_t>(best_at), best);
    legs.insert(legs.begin() + static_cast<std::ptrdiff_t>(best_at) + 1, legs_from(best));
  }
  for (std::size_t at = 0; at < tour.size();) {
    if (shown.only_by(tour[at]).empty()) {
      shown.count(tour[at], -1);
      tour.erase(tour.begin() + static_cast<std::ptrdiff_t>(at));
    } else {
      ++at;
    }
  }
  return tour;
}

VANTAGE_INLINE std::vector<std::size_t> cheapest_through(const std::vector<std::vector<std::size_t>>& layers,
                                                         std::size_t start, const LegCost& leg,
                                                         std::optional<std::size_t> end) {
  struct Reached {
    double cost = std::numeric_limits<double>::infinity();
    std::size_t before = 0;  // position in the layer before
  };
  std::vector<std::vector<Reached>> reached;
  const auto reach = [&](std::size_t view) {
    if (reached.empty()) {
      return Reached{leg(start, view), 0};
    }
    Reached best;
    const std::vector<std::size_t>& layer = layers[reached.size() - 1];
    for (std::size_t i = 0; i < layer.size(); ++i) {
      if (const double cost = reached.back()[i].cost + leg(layer[i], view); cost < best.cost) {
        best = {cost, i};
      }
    }
    return best;
  };
  for (const std::vector<std::size_t>& layer : layers) {
    std::vector<Reached> next;
    next.reserve(layer.size());
    for (const std::size_t view : layer) {
      next.push_back(reach(view));
    }
    reached.push_back(std::move(next));
  }
  const std::vector<Reached>& last = reached.back();
  const auto cheapest =
      std::min_element(last.begin(), last.end(), [](const Reached& a, const Reached& b) { return a.cost < b.cost; });
  std::size_t at = end ? reach(*end).before : static_cast<std::size_t>(cheapest - last.begin());
  std::vector<std::size_t> chosen(layers.size());
  for (std::size_t layer = layers.size(); layer-- > 0;) {
    chosen[layer] = layers[layer][at];
    at = reached[layer][at].before;
  }
  return chosen;
}

VANTAGE_INLINE std::vector<std::size_t> refined_tour(const CoverTourProblem& problem, std::vector<std::size_t> tour,
                                                     std::size_t layers) {
  layers = std::min(layers, tour.size());
  if (layers == 0) {
    return tour;
  }
  const Shown shown(problem, tour);
  std::vector<std::vector<std::size_t>> choices;
  choices.reserve(layers);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const std::size_t replaced = tour[layer];
    const std::vector<std::uint32_t> own = shown.only_by(replaced);
    const auto serves = [&](std::size_t view) {
      std::vector<std::uint32_t> common;
      std::set_intersection(own.begin(), own.end(), problem.sees[view].begin(), problem.sees[view].end(),
                            std::back_inserter(common));
      return static_cast<double>(common.size()) >= kNearlyAll * static_cast<double>(own.size()) &&
             static_cast<double>(problem.sees[view].size()) >=
                 kNearlyAll * static_cast<double>(problem.sees[replaced].size());
    };
    choices.push_back({replaced});
    for (std::size_t view = 0; view < problem.size(); ++view) {
      if (view != replaced && serves(view)) {
        choices.back().push_back(view);
      }
    }
  }
  const auto end = layers < tour.size() ? std::optional(tour[layers]) : std::nullopt;
  const std::vector<std::size_t> chosen = cheapest_through(choices, problem.size(), problem.leg, end);
  std::copy(chosen.begin(), chosen.end(), tour.begin());
  return tour;
}

}  // namespace vantage::detail
