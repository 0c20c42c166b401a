// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/frontier/void_tiles.hpp>
#include <vantage/geometry/ellipsoid.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick_grid.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How well an ellipsoid fits the void cells of a cluster (Dornhege & Kleiner 2011, eq. 2).
enum class FitScore : std::uint8_t {
  /// Volume of the cells inside the ellipsoid, divided by the volume of the ellipsoid. The best value is 1. This is
  /// eq. 2 with the half axes used for lambda, which makes it a ratio of volumes.
  VolumeRatio,
  /// Eq. 2 as printed, with the eigenvalues of the covariance (m^2) used for lambda. Its unit is 1/m^3, and it falls
  /// as a cluster grows, whatever the shape. It limits the size of a cluster more than its misfit.
  Literal,
};

/// How void cells are clustered.
struct VoidClusterOptions {
  FitScore score = FitScore::VolumeRatio;  ///< measure of the fit
  /// A cluster grows while its score is at least this, > 0 (the paper gives no value). VolumeRatio is 0.79 for any
  /// box, 1 for a ball, and about 0.6 for two boxes that form an L.
  double min_score = 0.5;
  std::uint64_t seed = 1;  ///< seed of the random start cells
};

/// A void: a cluster of void cells and the ellipsoid fitted to it.
struct VoidCluster {
  VoxelIndex start;      ///< the cell from which it grew
  std::size_t size = 0;  ///< number of cells
  Ellipsoid ellipsoid;   ///< has the centroid and the covariance of the cells
  double score = 0.0;    ///< fit of the ellipsoid, see FitScore
};

/// A partition of void cells into clusters.
class VoidClusters {
 public:
  /// The cluster number of a cell that is not a void cell.
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// The clusters of the void cells of one tile (VoidTiles).
  using Tile = std::pair<VoxelIndex, std::shared_ptr<const VoidClusters>>;

  /// No clusters.
  VoidClusters() = default;
  /// Takes the clusters and the cluster number of each cell: an index into `clusters`, or kNone.
  VoidClusters(std::vector<VoidCluster> clusters, BrickGrid<std::uint32_t> numbers)
      : clusters_(std::move(clusters)), numbers_(std::move(numbers)) {}
  /// Joins the clusters of tiles, which are numbered in this order.
  explicit VoidClusters(std::span<const Tile> tiles);

  /// The clusters, in the order of their creation.
  [[nodiscard]] const std::vector<VoidCluster>& clusters() const { return clusters_; }
  /// The cluster that holds a cell, as an index into `clusters()`; kNone if the cell is not a void cell.
  [[nodiscard]] std::uint32_t number_at(const VoxelIndex& cell) const {
    if (joined_.empty()) {
      return numbers_[cell];
    }
    const std::size_t* const at = at_.find(VoidTiles::of_cell(cell));
    const std::uint32_t number = at == nullptr ? kNone : joined_[*at].clusters->numbers_[cell];
    return number == kNone ? kNone : joined_[*at].first + number;
  }

  /// Calls `visit(VoxelIndex)` for every cell of a cluster.
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    for (const Joined& joined : joined_) {
      joined.clusters->for_each_cell(visit);
    }
    for (std::size_t brick = 0; brick < numbers_.bricks(); ++brick) {
      for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
        if (numbers_.values(brick)[offset] != kNone) {
          visit(Brick::cell_at(numbers_.address(brick), offset));
        }
      }
    }
  }

 private:
  struct Joined {
    std::shared_ptr<const VoidClusters> clusters;
    std::uint32_t first;  // number in `clusters_` of the first of these clusters
  };

  std::vector<VoidCluster> clusters_;
  BrickGrid<std::uint32_t> numbers_{kNone};  // empty if tiles were joined
  std::vector<Joined> joined_;
  VoxelTable<std::size_t> at_;  // index in `joined_`, by tile
};

/// Clusters void cells by region growing. A region starts at a random cell that has no cluster yet. It grows by one
/// layer of cells in all directions (steps along x, y and z, through faces) until the fit of its ellipsoid would fall
/// below `min_score`. This repeats until every cell has a cluster.
///
/// The order of `cells` does not matter, and duplicates count once. Every cluster is connected through faces. Equal
/// cells and an equal seed give equal clusters. Throws std::invalid_argument if `min_score` is not positive.
/// (Dornhege & Kleiner 2011, IV-B, after Pauling et al. 2009.)
[[nodiscard]] VoidClusters cluster_void_cells(std::span<const VoxelIndex> cells, const VoxelFrame& frame,
                                              const VoidClusterOptions& options = {});

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/void_clusters.ipp>
#endif
