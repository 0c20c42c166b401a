// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <vantage/evaluation/spread.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    throw std::invalid_argument("quantile: there is no value");
  }
  detail::require_option(share >= 0.0 && share <= 1.0, "quantile: share", share, "in [0, 1]");
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  const double weight = place - static_cast<double>(low);
  if (weight == 0.0 || values[low] == values[high]) {
    return values[low];  // also where the other is infinite
  }
  return values[low] + weight * (values[high] - values[low]);
}

std::string spread_text(const std::vector<double>& values, int digits) {
  if (values.empty()) {
    return "-";
  }
  const auto text_at = [&](double share) {
    const double value = quantile(values, share);
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits) << value;
    return std::isfinite(value) ? text.str() : "never";
  };
  std::string text = text_at(0.5);
  if (values.size() > 1) {
    text += " (" + text_at(0.25) + "-" + text_at(0.75) + ")";
  }
  return text;
}

}  // namespace vantage
