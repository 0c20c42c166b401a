// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vantage/map/impl/instruction_set.hpp>

namespace vantage {

/// The rows of four slices, four rows per slice.
using WordRows = std::array<std::uint32_t, 16>;

/// Converts up to eight adjacent words, ordered by slices (in_slices), to rows of cells. Word i gives the columns 4 i
/// to 4 i + 3.
[[nodiscard]] WordRows rows_of_words(std::span<const std::uint64_t> words, InstructionSet set);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/word_rows.ipp>
#endif
