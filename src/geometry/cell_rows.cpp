// SPDX-License-Identifier: MIT
#include "geometry/cell_rows.hpp"

#include <algorithm>

namespace vantage::detail {

// Axis by axis.
CellRows grown(const CellRows& cells, std::int32_t by) {
  const VoxelBox& box = cells.box();
  const auto for_each_row = [&](const auto& visit) {
    for (std::int32_t z = box.lo.z; z < box.hi.z; ++z) {
      for (std::int32_t y = box.lo.y; y < box.hi.y; ++y) {
        visit(y, z);
      }
    }
  };
  const auto join = [](std::span<std::uint64_t> into, std::span<const std::uint64_t> row) {
    std::transform(into.begin(), into.end(), row.begin(), into.begin(), [](auto a, auto b) { return a | b; });
  };
  CellRows along_x(box);
  for_each_row([&](std::int32_t y, std::int32_t z) {
    const std::span<std::uint64_t> into = along_x.row(y, z);
    for (std::int32_t step = -by; step <= by; ++step) {
      for (std::size_t word = 0; word < into.size(); ++word) {
        into[word] |= shifted_word(cells.row(y, z), word, step);
      }
    }
  });
  CellRows along_y(box);
  for_each_row([&](std::int32_t y, std::int32_t z) {
    for (std::int32_t other = std::max(y - by, box.lo.y); other <= std::min(y + by, box.hi.y - 1); ++other) {
      join(along_y.row(y, z), along_x.row(other, z));
    }
  });
  CellRows along_z(box);
  for_each_row([&](std::int32_t y, std::int32_t z) {
    for (std::int32_t other = std::max(z - by, box.lo.z); other <= std::min(z + by, box.hi.z - 1); ++other) {
      join(along_z.row(y, z), along_y.row(y, other));
    }
  });
  return along_z;
}

}  // namespace vantage::detail
