// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::detail {

/// Tolerance in cells: a cell whose centre lies on a facet belongs to the hull despite rounding.
inline constexpr double kOnFacet = 1e-6;

}  // namespace vantage::detail
