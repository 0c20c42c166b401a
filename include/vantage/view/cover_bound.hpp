// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/cell_set.hpp>

namespace VANTAGE_EXPORT vantage {

/// How many views it takes at least to see all that they can: a number that no choice among `seen`, sets of cells of
/// one box, falls short of whose union holds every cell of `wanted`. Cells of `wanted` that no set holds do not
/// count; 0 where none is left.
///
/// It proves itself: give every cell a weight; then it takes at least the weight of all cells over that of the
/// heaviest view (the dual of the fractional set cover). The weights are found by `rounds` multiplicative updates
/// (Plotkin, Shmoys & Tardos 1995): cells of the heaviest view become lighter. So it is at most the fractional
/// cover's, which it comes near to, and rounded up it is a bound, too. Only the `most_cells` of the wanted that
/// fewest views see are given a weight.
[[nodiscard]] double fewest_views_bound(std::span<const CellSet> seen, const CellSet& wanted,
                                        std::size_t rounds = 20'000, std::size_t most_cells = 2'000);

}  // namespace vantage
