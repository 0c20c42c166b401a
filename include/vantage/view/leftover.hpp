// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// Frontier cells that are no targets, by cause. The planners for an object (`next-best-view`) count unknown cells or
/// faces of the object instead.
struct Leftover {
  std::size_t unreachable = 0;  ///< not close to any reachable cell
  /// No reachable pose of this sensor has a line of sight to the unknown cells behind them.
  std::size_t unobservable = 0;
  std::size_t in_vain = 0;  ///< looked at from enough different places without a result (TriedViews)

  /// Compares all counts.
  friend bool operator==(const Leftover&, const Leftover&) = default;
};

}  // namespace vantage
