// SPDX-License-Identifier: MIT
#include "sim/pocket_tree.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>

namespace vantage {

PocketTree::PocketTree(const StepGraph& graph)
    : depth_(distances_from(graph, std::vector<std::uint32_t>{0})),
      parent_(graph.size(), 0),
      furthest_first_(graph.size()),
      rank_(graph.size()),
      due_(graph.size(), 0) {
  std::iota(furthest_first_.begin(), furthest_first_.end(), 0U);
  std::stable_sort(furthest_first_.begin(), furthest_first_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return depth_[a] > depth_[b]; });
  for (std::uint32_t rank = 0; rank < furthest_first_.size(); ++rank) {
    rank_[furthest_first_[rank]] = rank;
  }
  // Each place joins the pockets beside it. `within` leads from a place towards the pocket that holds it by now.
  std::vector<std::uint32_t> within(graph.size());
  std::iota(within.begin(), within.end(), 0U);
  const auto pocket_now = [&](std::uint32_t place) {
    while (within[place] != place) {
      place = within[place] = within[within[place]];
    }
    return place;
  };
  for (const std::uint32_t place : furthest_first_) {
    for (const auto& step : graph.steps(place)) {
      const std::uint32_t pocket = rank_[step.to] < rank_[place] ? pocket_now(step.to) : place;
      if (pocket != place) {
        parent_[pocket] = within[pocket] = place;
      }
    }
  }
  due_[0] = 1;
}

std::uint32_t PocketTree::pocket_of(std::span<const std::uint32_t> places) const {
  // The furthest of the pockets is replaced by its parent until one is left.
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> ranks;
  for (const std::uint32_t place : places) {
    ranks.push(rank_[place]);
  }
  for (;;) {
    const std::uint32_t rank = ranks.top();
    while (!ranks.empty() && ranks.top() == rank) {
      ranks.pop();
    }
    const std::uint32_t pocket = furthest_first_[rank];
    if (ranks.empty() || is_due(pocket)) {
      return pocket;
    }
    ranks.push(rank_[parent_[pocket]]);
  }
}

double PocketTree::gain(std::uint32_t pocket) const {
  std::uint32_t about = pocket;
  while (!is_due(about)) {
    about = parent_[about];
  }
  return static_cast<double>(depth_[pocket]) - static_cast<double>(depth_[about]);
}

void PocketTree::make_due(std::uint32_t pocket) {
  length_ += gain(pocket);
  deepest_ = std::max(deepest_, depth_[pocket]);
  for (; !is_due(pocket); pocket = parent_[pocket]) {
    due_[pocket] = 1;
  }
}

}  // namespace vantage
