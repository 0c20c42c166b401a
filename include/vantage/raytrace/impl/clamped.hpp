// SPDX-License-Identifier: MIT
#pragma once

namespace vantage {

/// Clamps a value to [least, most]; NaN becomes `least`. Branch-free, for vectorised loops. (g++ 12 vectorises such a
/// loop only if the limits are not compile-time constants.)
struct Clamped {
  double least;
  double most;

  /// The clamped value.
  [[nodiscard]] double operator()(double value) const {
    const double no_less = value > least ? value : least;
    return no_less < most ? no_less : most;
  }
};

}  // namespace vantage
