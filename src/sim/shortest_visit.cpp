// SPDX-License-Identifier: MIT
#include "sim/shortest_visit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace vantage {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

// A queue of states in the order of their cost, with one bucket per whole number of cells. No step is shorter than
// one cell, so a successor lies in a later bucket or, after rounding, later in the same one.
class Buckets {
 public:
  void push(std::size_t state, float cost) {
    const auto bucket = static_cast<std::size_t>(cost);
    if (bucket >= buckets_.size()) {
      buckets_.resize(bucket + 1);
    }
    buckets_[bucket].push_back({state, cost});
  }

  // Calls `settle(state)` in the order of cost, bucket by bucket, until `done()` is true between two buckets.
  // Skips entries whose state has become cheaper since they were pushed.
  template <class Settle, class Done>
  void run(const std::vector<float>& cost, const Settle& settle, const Done& done) {
    for (std::size_t bucket = 0; bucket < buckets_.size() && !done(); ++bucket) {
      for (std::size_t i = 0; i < buckets_[bucket].size(); ++i) {
        const Entry entry = buckets_[bucket][i];
        if (entry.cost <= cost[entry.state]) {
          settle(entry.state);
        }
      }
      buckets_[bucket] = {};
    }
  }

 private:
  struct Entry {
    std::size_t state;
    float cost;
  };
  std::vector<std::vector<Entry>> buckets_;
};

// Dijkstra over pairs of a cell and the sets visited so far: state = visited * cells + cell.
class VisitSearch {
 public:
  VisitSearch(const StepGraph& graph, std::span<const std::uint16_t> member, std::size_t sets)
      : graph_(graph), member_(member), all_((std::size_t{1} << sets) - 1), cost_(graph.size() << sets, kNever) {}

  Visit run() {
    std::size_t last = cost_.size();
    const auto offer = [&](std::size_t state, float cost) {
      if (cost < cost_[state]) {
        cost_[state] = cost;
        queue_.push(state, cost);
      }
    };
    offer(state_at(0, 0), 0.0F);
    queue_.run(
        cost_,
        [&](std::size_t state) {
          if (state / graph_.size() == all_) {
            last = last == cost_.size() || cost_[state] < cost_[last] ? state : last;
            return;
          }
          for (const auto& [to, length] : graph_.steps(state % graph_.size())) {
            offer(state_at(to, state / graph_.size()), cost_[state] + length);
          }
        },
        [&] { return last != cost_.size(); });
    return last == cost_.size() ? Visit{} : way_to(last);
  }

 private:
  std::size_t state_at(std::size_t cell, std::size_t visited_before) const {
    return (visited_before | member_[cell]) * graph_.size() + cell;
  }

  // The path to a state, found backwards along the steps that gave the costs.
  Visit way_to(std::size_t state) const {
    Visit visit{{}, cost_[state]};
    while (cost_[state] > 0.0F) {
      visit.cells.push_back(static_cast<std::uint32_t>(state % graph_.size()));
      state = before(state);
    }
    visit.cells.push_back(static_cast<std::uint32_t>(state % graph_.size()));
    std::reverse(visit.cells.begin(), visit.cells.end());
    return visit;
  }
  std::size_t before(std::size_t state) const {
    std::size_t found = state;
    for (const auto& [from, length] : graph_.steps(state % graph_.size())) {
      for (std::size_t visited = 0; visited <= all_ && found == state; ++visited) {
        const std::size_t earlier = visited * graph_.size() + from;
        if (cost_[earlier] + length == cost_[state] && state_at(state % graph_.size(), visited) == state) {
          found = earlier;
        }
      }
    }
    return found;
  }

  const StepGraph& graph_;
  std::span<const std::uint16_t> member_;
  std::size_t all_;
  std::vector<float> cost_;
  Buckets queue_;
};

}  // namespace

const std::vector<WideStep>& wide_steps() {
  static const std::vector<WideStep> all_steps = [] {
    std::vector<WideStep> steps;
    for_each_cell({{-2, -2, -2}, {3, 3, 3}}, [&](const VoxelIndex& by) {
      if (std::gcd(std::gcd(by.x, by.y), by.z) == 1) {
        steps.push_back({by, std::sqrt(static_cast<float>(by.x * by.x + by.y * by.y + by.z * by.z))});
      }
    });
    return steps;
  }();
  return all_steps;
}

StepGraph::StepGraph(const NumberedCells& space) {
  const auto for_each_step = [&](const auto& use) {
    for (std::size_t cell = 0; cell < space.size(); ++cell) {
      for (const WideStep& step : wide_steps()) {
        const std::uint32_t to = space.number_of(space.cells()[cell] + step.by);
        if (to != NumberedCells::kOutside) {
          use(cell, Step{to, step.length});
        }
      }
    }
  };
  first_.assign(space.size() + 1, 0);
  for_each_step([&](std::size_t from, const Step&) { ++first_[from + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  steps_.reserve(first_.back());
  for_each_step([&](std::size_t, const Step& step) { steps_.push_back(step); });
}

std::vector<float> distances_from(const StepGraph& graph, std::span<const std::uint32_t> from) {
  std::vector<float> distance(graph.size(), kNever);
  Buckets queue;
  for (const std::uint32_t cell : from) {
    distance[cell] = 0.0F;
    queue.push(cell, 0.0F);
  }
  queue.run(
      distance,
      [&](std::size_t cell) {
        for (const auto& [to, length] : graph.steps(cell)) {
          if (distance[cell] + length < distance[to]) {
            distance[to] = distance[cell] + length;
            queue.push(to, distance[to]);
          }
        }
      },
      [] { return false; });
  return distance;
}

Visit shortest_visit(const StepGraph& graph, std::span<const std::uint16_t> member, std::size_t sets) {
  return VisitSearch(graph, member, sets).run();
}

}  // namespace vantage
