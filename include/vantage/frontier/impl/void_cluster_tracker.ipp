// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/frontier/void_cluster_tracker.hpp>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage {

VANTAGE_INLINE VoidClusters VoidClusterTracker::update(const BrickSet& cells, const VoxelFrame& frame) {
  std::map<VoxelIndex, Tile, RasterOrder> kept;
  if (frame.size_m == frame_.size_m) {
    kept.swap(tiles_);
  }
  tiles_.clear();
  frame_ = frame;
  cells.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& voids) {
    if (detail::any(voids)) {
      tiles_[Brick::of_cell(brick)].bricks.emplace_back(brick, voids);
    }
  });
  std::vector<VoidClusters::Tile> all;
  all.reserve(tiles_.size());
  for (auto& [address, tile] : tiles_) {
    if (const auto same = kept.find(address); same != kept.end() && same->second.bricks == tile.bricks) {
      tile.clusters = std::move(same->second.clusters);
    } else {
      std::vector<VoxelIndex> voids;
      for (const auto& [brick, plane] : tile.bricks) {
        detail::append(plane, brick, voids);
      }
      tile.clusters = std::make_shared<const VoidClusters>(cluster_void_cells(voids, frame, options_));
    }
    all.emplace_back(address, tile.clusters);
  }
  return VoidClusters(all);
}

}  // namespace vantage
