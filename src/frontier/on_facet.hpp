// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::detail {

/// The centre of a cell on a facet of a hull belongs to the hull; this is what rounding may do to it, in cells.
inline constexpr double kOnFacet = 1e-6;

}  // namespace vantage::detail
