// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <random>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/field/potential.hpp>
#include <vector>

namespace vantage {

/// The value of every cell of a problem, by position; NaN where the potential has none.
inline std::vector<double> values_of(const Potential& potential, const LaplaceProblem& problem) {
  std::vector<double> values;
  for (const VoxelIndex& cell : problem.cells()) {
    values.push_back(potential.at(cell).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return values;
}

/// A small random domain: a box with edges of 1 to 6 cells, possibly flat, without some random cells, with a random
/// source and sinks. Cells that are not connected with the source are included; the problem must drop them.
struct RandomLaplace {
  std::vector<VoxelIndex> cells;
  std::vector<VoxelIndex> sinks;
  VoxelIndex source;

  explicit RandomLaplace(std::mt19937& engine, std::int32_t longest = 6) {
    const auto up_to = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(engine); };
    const auto edge = [&] { return std::uniform_int_distribution<std::int32_t>(1, longest)(engine); };
    const VoxelIndex lo{edge() - 4, edge() - 4, edge() - 4};
    const double share_open = std::uniform_real_distribution<double>(0.6, 1.0)(engine);
    std::bernoulli_distribution open(share_open);
    while (cells.size() < 3) {
      cells.clear();
      const VoxelIndex extent{edge() + 1, edge(), edge()};
      for_each_cell({lo, lo + extent}, [&](const VoxelIndex& cell) {
        if (open(engine)) {
          cells.push_back(cell);
        }
      });
    }
    source = cells[up_to(cells.size())];
    const std::size_t wanted = 1 + up_to(3);
    while (sinks.size() < wanted) {
      if (const VoxelIndex sink = cells[up_to(cells.size())]; sink != source) {
        sinks.push_back(sink);
      }
    }
  }
  [[nodiscard]] LaplaceProblem problem() const { return LaplaceProblem(cells, sinks, source); }
};

}  // namespace vantage
