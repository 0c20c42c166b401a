// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace vantage::detail {

/// Round numbers along an axis, and how they are written.
struct AxisTicks {
  double step = 1.0;
  std::vector<double> at;
  [[nodiscard]] std::string label(double value) const;
};

/// The largest number not above `value` (> 0) of the form 1, 2 or 5 times a power of ten.
[[nodiscard]] double round_down_to_nice(double value);
/// About `count` multiples of 1, 2 or 5 times a power of ten in [low, high].
[[nodiscard]] AxisTicks axis_ticks(double low, double high, double count);
/// Formats `value` with as many decimals as `step` needs; never "-0".
[[nodiscard]] std::string write_number(double value, double step);

}  // namespace vantage::detail
