// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/impl/along.hpp>
#include <vantage/view/impl/frontier_sites.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/geometry/impl/box_around.hpp>

namespace vantage::detail {

using Cells = std::vector<VoxelIndex>;

// Halves at the middle of the side that is longest for what it may be.
inline void divide(Cells cells, const VoxelIndex& most, std::vector<Cells>& parts) {
  const VoxelBox box = box_around(cells);
  const VoxelIndex extent = box.extent();
  const auto too_long = [&](std::size_t axis) {
    return static_cast<double>(along(extent, axis)) / static_cast<double>(along(most, axis));
  };
  const std::array<double, 3> sides{too_long(0), too_long(1), too_long(2)};
  const auto longest = std::max_element(sides.begin(), sides.end());
  if (*longest <= 1.0) {
    parts.push_back(std::move(cells));
    return;
  }
  const auto axis = static_cast<std::size_t>(longest - sides.begin());
  const std::int32_t middle = along(box.lo, axis) + along(extent, axis) / 2;
  const auto upper = std::stable_partition(cells.begin(), cells.end(),
                                           [&](const VoxelIndex& cell) { return along(cell, axis) < middle; });
  divide({cells.begin(), upper}, most, parts);
  divide({upper, cells.end()}, most, parts);
}

inline FrontierSite site_of(const Cells& cells, const std::vector<FrontierTarget>& targets) {
  FrontierSite site;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto position_of = [](const VoxelIndex& cell) { return Eigen::Vector3d(cell.x, cell.y, cell.z); };
  for (const VoxelIndex& cell : cells) {
    sum += position_of(cell);
    site.targets.push_back(*std::lower_bound(targets.begin(), targets.end(), cell,
                                             [](const FrontierTarget& target, const VoxelIndex& wanted) {
                                               return RasterOrder{}(target.frontier, wanted);
                                             }));
  }
  const Eigen::Vector3d centroid = sum / static_cast<double>(cells.size());
  site.middle = *std::min_element(site.targets.begin(), site.targets.end(),
                                  [&](const FrontierTarget& a, const FrontierTarget& b) {
                                    return (position_of(a.frontier) - centroid).squaredNorm() <
                                           (position_of(b.frontier) - centroid).squaredNorm();
                                  });
  return site;
}

VANTAGE_INLINE std::vector<FrontierSite> frontier_sites(const std::vector<FrontierTarget>& targets,
                                                        const VoxelIndex& most) {
  Cells cells;
  cells.reserve(targets.size());
  for (const FrontierTarget& target : targets) {
    cells.push_back(target.frontier);
  }
  std::vector<Cells> parts;
  for (Cells& cluster : frontier_clusters(cells)) {
    divide(std::move(cluster), most, parts);
  }
  std::vector<FrontierSite> sites;
  sites.reserve(parts.size());
  for (const Cells& part : parts) {
    sites.push_back(site_of(part, targets));
  }
  return sites;
}

}  // namespace vantage::detail
