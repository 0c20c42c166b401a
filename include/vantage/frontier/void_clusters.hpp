// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/ellipsoid.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/brick_grid.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How well an ellipsoid stands for the void cells of a cluster, Dornhege & Kleiner 2011, eq. 2.
enum class FitScore : std::uint8_t {
  /// The volume of the cells inside the ellipsoid over that of the ellipsoid, 1 at best: eq. 2 with the half axes in
  /// the place of lambda, which is what makes it a ratio of volumes.
  VolumeRatio,
  /// Eq. 2 to the letter, with the eigenvalues of the covariance (m^2) in the place of half axes. It is a ratio per
  /// cubic metre and falls as a cluster grows, whatever its shape: a bound on the size more than on the fit.
  Literal,
};

/// How void cells are clustered.
struct VoidClusterOptions {
  FitScore score = FitScore::VolumeRatio;  ///< what tells how well an ellipsoid fits
  /// A cluster grows while its score is at least this, > 0 (the paper names no value). A box scores 0.79 whatever its
  /// sides, a ball 1, two boxes that form an L about 0.6.
  double min_score = 0.5;
  std::uint64_t seed = 1;  ///< of the places where clusters start
};

/// A void: a cluster of void cells and the ellipsoid that stands for it.
struct VoidCluster {
  VoxelIndex start;      ///< the cell from which it grew
  std::size_t size = 0;  ///< how many cells it has
  Ellipsoid ellipsoid;   ///< with the centroid and covariance of its cells
  double score = 0.0;    ///< how well that fits
};

/// A partition of void cells into clusters.
class VoidClusters {
 public:
  /// The number of what is no void cell.
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  VoidClusters() = default;
  /// From the cluster of each cell, numbered as `clusters`; kNone elsewhere.
  VoidClusters(std::vector<VoidCluster> clusters, BrickGrid<std::uint32_t> numbers)
      : clusters_(std::move(clusters)), numbers_(std::move(numbers)) {}

  /// The clusters, in the order in which they were started.
  [[nodiscard]] const std::vector<VoidCluster>& clusters() const { return clusters_; }
  /// The cluster that holds a cell, as a position in `clusters()`; kNone where the cell is none of the void cells.
  [[nodiscard]] std::uint32_t number_at(const VoxelIndex& cell) const { return numbers_[cell]; }

  /// Calls `visit(VoxelIndex)` for every void cell.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    for (std::size_t brick = 0; brick < numbers_.bricks(); ++brick) {
      for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
        if (numbers_.values(brick)[offset] != kNone) {
          visit(Brick::first_cell(numbers_.address(brick)) + Brick::cell_at(offset));
        }
      }
    }
  }

 private:
  std::vector<VoidCluster> clusters_;
  BrickGrid<std::uint32_t> numbers_{kNone};
};

/// Clusters void cells as Dornhege & Kleiner 2011, IV-B, after Pauling et al. 2009: from a cell drawn at random among
/// those that have no cluster yet, a region grows by one cell on every side at a time (steps along x, y and z,
/// through faces) until the ellipsoid of its cells would fit worse than asked for, and so on until every cell has its
/// cluster.
///
/// Cells may come in any order; each counts once. Every cluster is connected through faces. The same cells and seed
/// give the same clusters. Throws std::invalid_argument naming the option at fault.
[[nodiscard]] VoidClusters cluster_void_cells(std::span<const VoxelIndex> cells, const VoxelFrame& frame,
                                              const VoidClusterOptions& options = {});

}  // namespace vantage
