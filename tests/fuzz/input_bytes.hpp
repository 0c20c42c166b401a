// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace vantage::fuzz {

/// Reads an input as a sequence of small numbers; zeros after its end.
class InputBytes {
 public:
  InputBytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  [[nodiscard]] bool empty() const { return at_ >= size_; }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : data_[at_++]; }
  /// In [-128, 127].
  std::int32_t small() { return static_cast<std::int8_t>(byte()); }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

/// Seeds of random bytes, for targets to which any bytes make sense.
inline std::vector<std::string> random_seeds(std::size_t bytes) {
  std::mt19937 engine(1);
  std::vector<std::string> seeds(8);
  for (std::string& seed : seeds) {
    for (std::size_t i = 0; i < bytes; ++i) {
      seed.push_back(static_cast<char>(engine() & 0xFFU));
    }
  }
  return seeds;
}

}  // namespace vantage::fuzz
