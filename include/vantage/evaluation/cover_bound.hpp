// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/cell_set.hpp>

namespace VANTAGE_EXPORT vantage {

/// A lower bound on the number of views in any set cover: no smaller selection from `seen` contains every cell of
/// `wanted`. All sets must have the same box. Cells of `wanted` that are in no set are ignored. Returns 0 if no cell
/// is left. The result is not rounded; rounded up it is still a valid bound.
///
/// Method: for any weights of the cells, at least (weight of all cells) / (weight of the heaviest view) views are
/// needed. This is the dual of the fractional set cover, so every weighting gives a valid bound. The weights are
/// improved by `rounds` multiplicative updates, which make the cells of the heaviest view lighter. The bound
/// approaches the fractional cover from below. Only the `most_cells` wanted cells that are seen by the fewest views
/// get a weight. (Plotkin, Shmoys & Tardos 1995.)
[[nodiscard]] double fewest_views_bound(std::span<const CellSet> seen, const CellSet& wanted,
                                        std::size_t rounds = 20'000, std::size_t most_cells = 2'000);

}  // namespace vantage
