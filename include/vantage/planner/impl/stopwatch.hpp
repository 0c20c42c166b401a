// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <utility>

namespace vantage::detail {

/// Measures milliseconds since its construction or the last `lap_ms`.
class Stopwatch {
 public:
  [[nodiscard]] double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace vantage::detail
