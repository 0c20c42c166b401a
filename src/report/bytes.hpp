// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vantage::detail {

/// Writes numbers as bytes, little endian; `count` and `integer` use few bytes for small numbers.
class ByteWriter {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void word(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i, value >>= 8U) {
      byte(static_cast<std::uint8_t>(value & 0xFFU));
    }
  }
  void real(double value) { word(std::bit_cast<std::uint64_t>(value), 8); }
  void small_real(float value) { word(std::bit_cast<std::uint32_t>(value), 4); }
  /// Variable length, seven bits per byte.
  void count(std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) {
      byte(static_cast<std::uint8_t>(value | 0x80U));
    }
    byte(static_cast<std::uint8_t>(value));
  }
  /// Variable length with a sign: 0, -1, 1, -2 ... are the counts 0, 1, 2, 3 ...
  void integer(std::int64_t value) {
    count((static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63));
  }
  void text(std::string_view value) {
    count(value.size());
    bytes_.append(value);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. Throws std::runtime_error if too few bytes are left.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint8_t byte() { return static_cast<std::uint8_t>(take(1).front()); }
  std::uint64_t word(int size) {
    const std::string_view part = take(static_cast<std::size_t>(size));
    std::uint64_t value = 0;
    for (std::size_t i = part.size(); i-- > 0;) {
      value = value << 8U | static_cast<std::uint8_t>(part[i]);
    }
    return value;
  }
  double real() { return std::bit_cast<double>(word(8)); }
  float small_real() { return std::bit_cast<float>(static_cast<std::uint32_t>(word(4))); }
  std::uint64_t count() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint8_t next = byte();
      value |= std::uint64_t{next & 0x7FU} << shift;
      if ((next & 0x80U) == 0) {
        return value;
      }
    }
    throw std::runtime_error("a number is too long");
  }
  std::int64_t integer() {
    const std::uint64_t value = count();
    return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
  }
  std::string_view text() { return take(static_cast<std::size_t>(count())); }
  /// Number of items that follow, each of at least `least_bytes`. Throws if the remaining bytes cannot hold them.
  std::size_t length(std::size_t least_bytes) {
    const std::uint64_t value = count();
    if (value > bytes_.size() / least_bytes) {
      throw std::runtime_error("a list is longer than what holds it");
    }
    return static_cast<std::size_t>(value);
  }
  [[nodiscard]] bool spent() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) {
      throw std::runtime_error("it ends too early");
    }
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }

  std::string_view bytes_;
};

}  // namespace vantage::detail
