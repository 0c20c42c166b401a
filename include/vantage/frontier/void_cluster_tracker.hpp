// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/frontier/void_clusters.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/map/brick_set.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Clusters of void cells, tile by tile (VoidTiles), updated incrementally.
///
///     VoidClusterTracker clusters;
///     VoidClusters voids = clusters.update(tracker.cells_behind(frontier, near), map.frame());
///
/// The cells of each tile are clustered apart, as `cluster_void_cells` does, and the clusters are kept until the
/// cells of the tile change. So the cost of an update follows what has changed, and not the volume of the voids. A
/// cluster ends at the faces of its tile. The result depends on the cells alone, not on former updates.
class VoidClusterTracker {
 public:
  /// Starts without clusters.
  explicit VoidClusterTracker(const VoidClusterOptions& options = {}) : options_(options) {}

  /// The clusters of `cells`, tiles in raster order. Errors as `cluster_void_cells`.
  [[nodiscard]] VoidClusters update(const BrickSet& cells, const VoxelFrame& frame);

 private:
  struct Tile {
    std::vector<std::pair<VoxelIndex, BrickPlane>> bricks;  // their void cells
    std::shared_ptr<const VoidClusters> clusters;
  };

  VoidClusterOptions options_;
  VoxelFrame frame_{1.0};
  std::map<VoxelIndex, Tile, RasterOrder> tiles_;  // of the last update
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/void_cluster_tracker.ipp>
#endif
