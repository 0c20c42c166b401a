// SPDX-License-Identifier: MIT
#pragma once

namespace vantage {

/// The nearest value between limits; of what is no number, the least. Without a branch, for loops that are made
/// vectors. (g++ 12 makes a vector of limits only if it does not know them.)
struct Clamped {
  double least;
  double most;

  /// Of a value.
  [[nodiscard]] double operator()(double value) const {
    const double no_less = value > least ? value : least;
    return no_less < most ? no_less : most;
  }
};

}  // namespace vantage
