// SPDX-License-Identifier: MIT
#include "picture/axis_ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vantage::detail {

double round_down_to_nice(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  const double mantissa = value / power * (1.0 + 1e-9);
  return power * (mantissa >= 5.0 ? 5.0 : mantissa >= 2.0 ? 2.0 : 1.0);
}

AxisTicks axis_ticks(double low, double high, double count) {
  const double span = std::max(high - low, 1e-9);
  AxisTicks ticks{round_down_to_nice(span / count), {}};
  if (span / ticks.step > 1.7 * count) {
    ticks.step = round_down_to_nice(2.5 * ticks.step);
  }
  const double first = std::ceil(low / ticks.step - 1e-6);
  for (double k = first; k * ticks.step <= high + 1e-6 * ticks.step; k += 1.0) {
    ticks.at.push_back(k * ticks.step);
  }
  return ticks;
}

std::string write_number(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value) < 0.5 * step * 1e-3 ? 0.0 : value);
  return text;
}

std::string AxisTicks::label(double value) const { return write_number(value, step); }

}  // namespace vantage::detail
