// SPDX-License-Identifier: MIT
#include <iostream>
#include <vantage/vantage.hpp>

#if VANTAGE_VERSION < VANTAGE_VERSION_NUMBER(0, 1, 0) || VANTAGE_VERSION >= VANTAGE_VERSION_NUMBER(1, 0, 0)
#error "these are not the headers that were asked for"
#endif

int main() {
  vantage::OccupancyMap map({.resolution_m = 0.1});
  vantage::Scan scan;
  scan.points.emplace_back(0.05F, 0.05F, 1.05F);
  map.insert(scan);
  const vantage::OccupancyMap::Counts counts = map.counts();
  std::cout << "vantage " << VANTAGE_VERSION_STRING << ": " << counts.free << " free, " << counts.occupied << " occupied\n";
  return counts.free == 10 && counts.occupied == 1 ? 0 : 1;
}
