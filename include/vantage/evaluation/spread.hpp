// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The quantile at a share in [0, 1], linear between neighbouring values, which may be infinite. Throws
/// std::invalid_argument if there is no value or the share is outside [0, 1].
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// Text of the median, with quartiles behind it if there are several values: "15.7 (15.4-16.6)"; "never" for what is
/// infinite; "-" if there is no value.
[[nodiscard]] std::string spread_text(const std::vector<double>& values, int digits);

}  // namespace vantage
