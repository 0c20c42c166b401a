// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace vantage::drawing {

/// Round numbers along an axis and how they are written.
struct AxisTicks {
  double step = 1.0;
  std::vector<double> at;
  [[nodiscard]] std::string label(double value) const;
};

/// The largest of 1, 2, 5 times a power of ten that is not above `value` (> 0).
[[nodiscard]] double round_down_to_nice(double value);
/// Multiples of 1, 2 or 5 times a power of ten in [low, high], about `count` of them.
[[nodiscard]] AxisTicks axis_ticks(double low, double high, double count);
/// `value` with as many decimals as `step` needs, and no "-0".
[[nodiscard]] std::string write_number(double value, double step);

}  // namespace vantage::drawing
