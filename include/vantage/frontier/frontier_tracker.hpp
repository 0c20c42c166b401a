// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/voxel_clusters.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The frontier cells of a map and their clusters, updated incrementally from the map's change log.
///
///     FrontierTracker frontiers(map);
///     map.insert(scan);
///     frontiers.update();  // cost depends on what the scan has changed
///
/// After each update it holds exactly the result of `frontier_cells` and `frontier_clusters`, whatever the history of
/// the map. Updating the cells costs time for the changed bricks and their neighbours. Updating the clusters also
/// costs time for all bricks of every cluster that gained or lost a cell, because the cluster may have split. The map
/// must outlive the tracker.
class FrontierTracker {
 public:
  /// Computes the frontier of the map as it is now.
  explicit FrontierTracker(const OccupancyMap& map, Connectivity connectivity = Connectivity::Corner26);

  /// Applies the changes of the map since the last call. Returns the number of bricks in which the frontier has
  /// changed.
  std::size_t update();

  /// The number of frontier cells.
  [[nodiscard]] std::size_t cell_count() const { return cell_count_; }
  /// Whether a cell is a frontier cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const;
  /// All frontier cells in raster order (z, then y, then x), as `frontier_cells`.
  [[nodiscard]] std::vector<VoxelIndex> cells() const;

  /// The number of clusters.
  [[nodiscard]] std::size_t cluster_count() const { return clusters_.size() - unused_clusters_.size(); }
  /// The number of cells in the cluster of a frontier cell; 0 for any other cell.
  [[nodiscard]] std::size_t cluster_size(const VoxelIndex& cell) const;
  /// All clusters, as `frontier_clusters`: cells in raster order within a cluster, clusters ordered by their first
  /// cell.
  [[nodiscard]] std::vector<std::vector<VoxelIndex>> clusters() const;

 private:
  struct PieceNumber {
    std::uint32_t brick;
    std::uint32_t piece;
    friend bool operator==(const PieceNumber&, const PieceNumber&) = default;
  };
  // A connected component of the frontier cells of one brick. A cluster is a set of connected pieces.
  struct Piece {
    BrickPlane cells{};
    std::vector<PieceNumber> touching;  // the adjacent pieces in other bricks
    std::uint32_t cluster = 0;
  };
  struct BrickFrontier {
    VoxelIndex address;
    BrickPlane cells{};
    std::vector<Piece> pieces;
  };
  struct Cluster {
    std::vector<PieceNumber> pieces;
    std::size_t cells = 0;
  };

  struct Change {
    VoxelIndex brick;
    BrickPlane cells;
  };

  void regroup(const std::vector<Change>& changes);
  void dissolve(std::uint32_t cluster, std::vector<PieceNumber>& loose);
  void unlink(std::uint32_t brick);
  void replace(const Change& change, std::vector<PieceNumber>& loose);
  void link(const PieceNumber& number);
  void gather(const PieceNumber& first);
  std::uint32_t merge(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] Piece& at(const PieceNumber& number) { return bricks_[number.brick].pieces[number.piece]; }
  [[nodiscard]] std::uint32_t piece_at(std::uint32_t brick, std::size_t offset) const;
  [[nodiscard]] std::vector<PieceNumber> neighbours(const PieceNumber& number) const;

  const OccupancyMap* map_;
  Connectivity connectivity_;
  std::vector<VoxelIndex> steps_;  // offsets from a cell to its neighbours
  OccupancyMap::Revision revision_ = 0;
  std::size_t cell_count_ = 0;

  // index in `bricks_` of each brick that holds frontier cells
  std::unordered_map<VoxelIndex, std::uint32_t> numbers_;
  std::vector<BrickFrontier> bricks_;
  std::vector<std::uint32_t> unused_bricks_;
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> unused_clusters_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/frontier_tracker.ipp>
#endif
