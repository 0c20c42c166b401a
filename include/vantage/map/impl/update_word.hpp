// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace vantage::detail {

/// The beam model in steps of log-odds.
struct BeamSteps {
  std::int8_t hit;
  std::int8_t miss;
  std::int8_t min;
  std::int8_t max;
};

// Byte b of entry m is 0xFF if bit b of m is set, otherwise 0.
consteval std::array<std::uint64_t, 256> bytes_of_bits() {
  std::array<std::uint64_t, 256> table{};
  for (std::size_t mask = 0; mask < 256; ++mask) {
    for (std::size_t bit = 0; bit < 8; ++bit) {
      table[mask] |= (mask >> bit & 1U) != 0 ? std::uint64_t{0xFF} << 8 * bit : 0;
    }
  }
  return table;
}
inline constexpr std::array<std::uint64_t, 256> kBytesOfBits = bytes_of_bits();

/// Updates the 64 log-odds at `log_odds`: adds `beam.hit` where `hit` has a bit and `beam.miss` where `passed` has
/// one, and clamps. No cell may have both bits. Returns the mask of cells whose log-odds are now >= 0.
inline std::uint64_t update_word(std::int8_t* log_odds, std::uint64_t hit, std::uint64_t passed,
                                 const BeamSteps& beam) {
  constexpr std::uint64_t kOnes = 0x0101010101010101ULL;
  const std::uint64_t hits = kOnes * static_cast<std::uint8_t>(beam.hit);
  const std::uint64_t misses = kOnes * static_cast<std::uint8_t>(beam.miss);
  std::array<std::int8_t, 64> delta;
  for (std::size_t byte = 0; byte < 8; ++byte) {
    const std::uint64_t eight =
        (kBytesOfBits[hit >> 8 * byte & 0xFFU] & hits) | (kBytesOfBits[passed >> 8 * byte & 0xFFU] & misses);
    std::memcpy(&delta[8 * byte], &eight, sizeof(eight));
  }
  for (std::size_t i = 0; i < 64; ++i) {
    const auto sum = static_cast<std::int16_t>(log_odds[i] + delta[i]);
    const std::int16_t low = sum < beam.min ? beam.min : sum;
    log_odds[i] = static_cast<std::int8_t>(low > beam.max ? beam.max : low);
  }
  std::uint64_t negative = 0;
  for (std::size_t byte = 0; byte < 8; ++byte) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, log_odds + 8 * byte, sizeof(eight));
    negative |= ((eight & (kOnes << 7U)) * 0x0002040810204081ULL >> 56U) << 8 * byte;
  }
  return ~negative;
}

}  // namespace vantage::detail
