// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace vantage::test {

/// Bricks in order of creation, log-odds included.
inline void expect_equal_maps(const OccupancyMap& a, const OccupancyMap& b) {
  struct Content {
    VoxelIndex address;
    Brick cells;
  };
  const auto content = [](const OccupancyMap& map) {
    std::vector<Content> bricks;
    map.for_each_brick([&](const VoxelIndex& address, const Brick& cells) { bricks.push_back({address, cells}); });
    return bricks;
  };
  const std::vector<Content> of_a = content(a);
  const std::vector<Content> of_b = content(b);
  ASSERT_EQ(of_a.size(), of_b.size());
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    ASSERT_EQ(of_a[i].address, of_b[i].address);
    ASSERT_EQ(of_a[i].cells.known, of_b[i].cells.known);
    ASSERT_EQ(of_a[i].cells.occupied, of_b[i].cells.occupied);
    ASSERT_EQ(of_a[i].cells.log_odds, of_b[i].cells.log_odds);
  }
  ASSERT_EQ(a.bounds(), b.bounds());
  ASSERT_EQ(a.cells_refused(), b.cells_refused());
  ASSERT_EQ(a.memory_bytes(), b.memory_bytes());
}

}  // namespace vantage::test
