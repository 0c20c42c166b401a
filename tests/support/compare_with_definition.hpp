// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan_cells.hpp>

namespace vantage::test {

/// Inserts `scan` into a new map and expects the cells and counts of the definition. Returns the number of cells.
inline std::size_t compare_with_definition(const Scan& scan, const OccupancyMapOptions& options, RayPolicy policy) {
  OccupancyMap map(options);
  const ScanCells expected = scan_cells(scan, map, policy);
  const ScanReport report = map.insert(scan, policy);
  EXPECT_EQ(report.hits, expected.report.hits);
  EXPECT_EQ(report.beyond_range, expected.report.beyond_range);
  EXPECT_EQ(report.no_return, expected.report.no_return);
  EXPECT_EQ(report.not_finite, expected.report.not_finite);
  EXPECT_EQ(report.zero_length, expected.report.zero_length);
  EXPECT_EQ(report.not_addressable, expected.report.not_addressable);
  EXPECT_EQ(report.cells_hit, expected.hit.size());
  EXPECT_EQ(report.cells_cleared, expected.cleared.size());
  EXPECT_EQ(report.cells_changed, expected.hit.size() + expected.cleared.size());
  std::size_t known = 0;
  std::size_t wrong = 0;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy occupancy) {
    wrong += (occupancy == Occupancy::Occupied ? expected.hit : expected.cleared).contains(cell) ? 0U : 1U;
    ++known;
  });
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(known, expected.hit.size() + expected.cleared.size());
  return known;
}

}  // namespace vantage::test
