// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Few views that together see what all of them see: numbers of sets of cells of one box, chosen one after the other,
/// each the one that adds the most cells not yet seen (the greedy set cover, Chvatal 1979; ties to the lower number),
/// until none adds `min_new_cells`; then those are dropped, the first chosen first, without which the others still
/// see all but fewer than that many of its cells. In the order of choice.
[[nodiscard]] std::vector<std::size_t> cover_views(std::span<const CellSet> seen, std::size_t min_new_cells = 1);

}  // namespace vantage
