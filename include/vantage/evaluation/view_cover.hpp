// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Greedy set cover: selects few views that together see what all views see. `seen` holds the visible cells of each
/// view; all sets must have the same box. Each step selects the view with the most new cells (ties: the lower index).
/// Then redundant views are dropped, the first selected first. Returns indices into `seen` in the order of selection.
/// (Chvatal 1979.)
[[nodiscard]] std::vector<std::size_t> cover_views(std::span<const CellSet> seen);

}  // namespace vantage
