// SPDX-License-Identifier: MIT
#include <queue>
#include <vantage/evaluation/view_cover.hpp>

namespace vantage {
namespace {

// Number of new cells of a view at its last count. It can only decrease, so it is an upper bound (lazy greedy).
struct Gain {
  std::size_t cells;
  std::size_t view;

  friend bool operator<(const Gain& a, const Gain& b) {
    return a.cells != b.cells ? a.cells < b.cells : a.view > b.view;
  }
};

std::size_t cells_beyond(const CellSet& cells, const CellSet& known) {
  CellSet left = cells;
  left -= known;
  return left.size();
}

}  // namespace

std::vector<std::size_t> cover_views(std::span<const CellSet> seen) {
  std::vector<std::size_t> chosen;
  if (seen.empty()) {
    return chosen;
  }
  std::priority_queue<Gain> gains;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    gains.push({seen[i].size(), i});
  }
  CellSet covered(seen.front().box());
  while (!gains.empty() && gains.top().cells > 0) {
    const Gain top = gains.top();
    gains.pop();
    const std::size_t now = cells_beyond(seen[top.view], covered);
    if (now < top.cells) {
      gains.push({now, top.view});
      continue;
    }
    chosen.push_back(top.view);
    covered |= seen[top.view];
  }
  for (std::size_t i = 0; i < chosen.size();) {
    CellSet others(seen.front().box());
    for (const std::size_t view : chosen) {
      if (view != chosen[i]) {
        others |= seen[view];
      }
    }
    if (cells_beyond(covered, others) == 0) {
      chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  return chosen;
}

}  // namespace vantage
