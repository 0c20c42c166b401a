// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map/instruction_set.hpp>
#include <span>

namespace vantage {

/// Rows of cells of four slices, four rows of each slice.
using WordRows = std::array<std::uint32_t, 16>;

/// Up to eight words side by side, their slices one after the other (in_slices), as rows of cells: word i gives
/// columns 4 i to 4 i + 3.
[[nodiscard]] WordRows rows_of_words(std::span<const std::uint64_t> words, InstructionSet set);

}  // namespace vantage
