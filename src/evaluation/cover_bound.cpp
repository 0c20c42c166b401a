// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vantage/evaluation/cover_bound.hpp>
#include <vector>

namespace vantage {
namespace {

// Which views see which cells; cells are numbered.
struct Incidence {
  std::vector<std::vector<std::uint32_t>> views_of_cell;
  std::vector<std::vector<std::uint32_t>> cells_of_view;
};

// The wanted cells that are seen by the fewest views, but by at least one.
std::vector<VoxelIndex> rarest_cells(std::span<const CellSet> seen, const CellSet& wanted, std::size_t most_cells) {
  std::unordered_map<VoxelIndex, std::size_t> views;
  for (const CellSet& one : seen) {
    one.for_each([&](const VoxelIndex& cell) {
      if (wanted.contains(cell)) {
        ++views[cell];
      }
    });
  }
  std::vector<VoxelIndex> cells;
  wanted.for_each([&](const VoxelIndex& cell) {
    if (views.count(cell) > 0) {
      cells.push_back(cell);
    }
  });
  std::stable_sort(cells.begin(), cells.end(),
                   [&](const VoxelIndex& a, const VoxelIndex& b) { return views.at(a) < views.at(b); });
  cells.resize(std::min(cells.size(), most_cells));
  return cells;
}

Incidence incidence_of(std::span<const CellSet> seen, const std::vector<VoxelIndex>& cells) {
  Incidence incidence{std::vector<std::vector<std::uint32_t>>(cells.size()),
                      std::vector<std::vector<std::uint32_t>>(seen.size())};
  for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
    for (std::uint32_t view = 0; view < seen.size(); ++view) {
      if (seen[view].contains(cells[cell])) {
        incidence.views_of_cell[cell].push_back(view);
        incidence.cells_of_view[view].push_back(cell);
      }
    }
  }
  return incidence;
}

std::vector<double> loads(const Incidence& incidence, const std::vector<double>& weights) {
  std::vector<double> load(incidence.cells_of_view.size(), 0.0);
  for (std::size_t view = 0; view < load.size(); ++view) {
    for (const std::uint32_t cell : incidence.cells_of_view[view]) {
      load[view] += weights[cell];
    }
  }
  return load;
}

}  // namespace

double fewest_views_bound(std::span<const CellSet> seen, const CellSet& wanted, std::size_t rounds,
                          std::size_t most_cells) {
  constexpr double kFirstStep = 0.1;  // initial relative decrease of a weight, and how fast it shrinks
  constexpr double kSteps = 20.0;
  constexpr std::size_t kAnew = 64;  // the loads are recomputed after so many rounds to remove rounding errors
  const std::vector<VoxelIndex> cells = rarest_cells(seen, wanted, most_cells);
  if (cells.empty()) {
    return 0.0;
  }
  const Incidence incidence = incidence_of(seen, cells);
  std::vector<double> weights(cells.size(), 1.0);
  std::vector<double> load;
  double best = 0.0;
  for (std::size_t round = 0; round <= rounds; ++round) {
    if (round % kAnew == 0 || round == rounds) {
      const double heaviest_cell = *std::max_element(weights.begin(), weights.end());
      for (double& weight : weights) {
        weight /= heaviest_cell;
      }
      load = loads(incidence, weights);
      const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
      best = std::max(best, total / *std::max_element(load.begin(), load.end()));
    }
    const double share = kFirstStep / (1.0 + kSteps * static_cast<double>(round) / static_cast<double>(rounds + 1));
    const auto heaviest = static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin());
    for (const std::uint32_t cell : incidence.cells_of_view[heaviest]) {
      const double less = weights[cell] * share;
      weights[cell] -= less;
      for (const std::uint32_t view : incidence.views_of_cell[cell]) {
        load[view] -= less;
      }
    }
  }
  return best;
}

}  // namespace vantage
