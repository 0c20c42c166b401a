// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vantage/robot/capability_map.hpp>

#include <vantage/map/impl/file_bytes.hpp>
#include <vantage/map/impl/whole_file.hpp>

// File format: a title line, twelve 64-bit numbers (options, box of cells, number of words, checksum of all other
// numbers and words), the words. Little endian.

namespace vantage {
namespace detail {

inline constexpr std::string_view kTitle = "vantage capability map 1\n";

inline std::uint64_t checksum(std::span<const std::uint64_t> numbers, std::uint64_t sum = 0xCBF29CE484222325ULL) {
  for (const std::uint64_t number : numbers) {  // FNV-1a, by 64-bit numbers instead of bytes
    sum = (sum ^ number) * 0x100000001B3ULL;
    sum ^= sum >> 29U;
  }
  return sum;
}

inline void append_number(std::string& text, std::uint64_t number) {
  for (unsigned byte = 0; byte < 8; ++byte) {
    text.push_back(static_cast<char>(number >> 8 * byte & 0xFFU));
  }
}

inline std::uint64_t number_at(std::string_view text, std::size_t position) {
  std::uint64_t number = 0;
  for (unsigned byte = 0; byte < 8; ++byte) {
    number |= std::uint64_t{static_cast<unsigned char>(text[position + byte])} << 8 * byte;
  }
  return number;
}

inline std::uint64_t packed(std::int32_t value) { return static_cast<std::uint64_t>(std::int64_t{value}); }

inline std::int32_t coordinate(std::uint64_t number) {
  const auto value = static_cast<std::int64_t>(number);
  return value >= -kFurthestVoxel && value <= kFurthestVoxel ? static_cast<std::int32_t>(value) : kFurthestVoxel + 1;
}

inline bool plausible(const CapabilityMapOptions& options, const VoxelBox& cells) {
  constexpr std::int32_t kMost = 1 << 16;  // per axis, so that the product fits 64 bits
  const auto side = [](std::int32_t lo, std::int32_t hi) {
    return lo < hi && hi <= kFurthestVoxel && std::int64_t{hi} - lo <= kMost;
  };
  return std::isfinite(options.cell_m) && options.cell_m > 0.0 && options.direction_bins_per_edge >= 1 &&
         options.direction_bins_per_edge <= 32 && options.samples > 0 && side(cells.lo.x, cells.hi.x) &&
         side(cells.lo.y, cells.hi.y) && side(cells.lo.z, cells.hi.z);
}

}  // namespace detail

VANTAGE_INLINE void CapabilityMap::save(const std::filesystem::path& path) const {
  const std::array<std::uint64_t, 11> head{std::bit_cast<std::uint64_t>(options_.cell_m),
                                           detail::packed(options_.direction_bins_per_edge),
                                           options_.samples,
                                           options_.seed,
                                           detail::packed(cells_.lo.x),
                                           detail::packed(cells_.lo.y),
                                           detail::packed(cells_.lo.z),
                                           detail::packed(cells_.hi.x),
                                           detail::packed(cells_.hi.y),
                                           detail::packed(cells_.hi.z),
                                           bits_.size()};
  std::string text(detail::kTitle);
  for (const std::uint64_t number : head) {
    detail::append_number(text, number);
  }
  detail::append_number(text, detail::checksum(bits_, detail::checksum(head)));
  for (const std::uint64_t word : bits_) {
    detail::append_number(text, word);
  }
  detail::write_whole_file(path, text);
}

VANTAGE_INLINE CapabilityMap CapabilityMap::load(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& what) { throw std::runtime_error(path.string() + ": " + what); };
  constexpr std::size_t kMostBytes = std::size_t{1} << 32U;
  const std::string text = detail::file_bytes(path, kMostBytes);
  if (!text.starts_with(detail::kTitle)) {
    refuse("is no capability map");
  }
  constexpr std::size_t kNumbers = 12;
  const std::size_t body = detail::kTitle.size() + 8 * kNumbers;
  if (text.size() < body) {
    refuse("is truncated: it ends after " + std::to_string(text.size()) + " bytes, in its head");
  }
  std::array<std::uint64_t, kNumbers> head{};
  for (std::size_t i = 0; i < kNumbers; ++i) {
    head[i] = detail::number_at(text, detail::kTitle.size() + 8 * i);
  }
  CapabilityMap map;
  map.options_ = {std::bit_cast<double>(head[0]), detail::coordinate(head[1]), head[2], head[3]};
  map.cells_ = {{detail::coordinate(head[4]), detail::coordinate(head[5]), detail::coordinate(head[6])},
                {detail::coordinate(head[7]), detail::coordinate(head[8]), detail::coordinate(head[9])}};
  if (!detail::plausible(map.options_, map.cells_) || head[10] != map.cells_.size() * map.words_per_cell()) {
    refuse("its head makes no sense");
  }
  if ((text.size() - body) / 8 < head[10]) {
    refuse("is truncated: it holds " + std::to_string((text.size() - body) / 8) + " of " + std::to_string(head[10]) +
           " words");
  }
  if (text.size() != body + 8 * head[10]) {
    refuse("goes on after its end");
  }
  map.bits_.reserve(head[10]);
  for (std::size_t word = 0; word < head[10]; ++word) {
    map.bits_.push_back(detail::number_at(text, body + 8 * word));
  }
  if (detail::checksum(map.bits_, detail::checksum(std::span(head).first(kNumbers - 1))) != head[kNumbers - 1]) {
    refuse("is damaged: its checksum does not fit");
  }
  return map;
}

}  // namespace vantage
