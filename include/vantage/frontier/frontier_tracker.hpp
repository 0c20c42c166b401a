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

/// The frontier cells of a map and their clusters, kept up to date from the map's change log.
///
///     FrontierTracker frontiers(map);
///     map.insert(scan);
///     frontiers.update();  // costs what the scan changed
///
/// At every moment it holds what `frontier_cells` and `frontier_clusters` would find in the map of the last update,
/// whatever the way by which the map came there. Cells cost the bricks that changed and their neighbours; clusters
/// cost, besides, the bricks of every cluster that lost or gained a cell, for it may have fallen apart. The map must
/// outlive the tracker.
class FrontierTracker {
 public:
  /// Takes the map as it is now.
  explicit FrontierTracker(const OccupancyMap& map, Connectivity connectivity = Connectivity::Corner26);

  /// Follows the changes of the map since the last call. Returns in how many bricks the frontier has changed.
  std::size_t update();

  /// How many frontier cells there are.
  [[nodiscard]] std::size_t cell_count() const { return cell_count_; }
  /// Whether a cell is one of them.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const;
  /// All of them, in raster order: `frontier_cells` of the map.
  [[nodiscard]] std::vector<VoxelIndex> cells() const;

  /// How many clusters there are.
  [[nodiscard]] std::size_t cluster_count() const { return clusters_.size() - unused_clusters_.size(); }
  /// How many cells the cluster of a frontier cell has; 0 for any other cell.
  [[nodiscard]] std::size_t cluster_size(const VoxelIndex& cell) const;
  /// Cells in raster order within a cluster, clusters by their first cells: `frontier_clusters` of the cells.
  [[nodiscard]] std::vector<std::vector<VoxelIndex>> clusters() const;

 private:
  struct PieceNumber {
    std::uint32_t brick;
    std::uint32_t piece;
    friend bool operator==(const PieceNumber&, const PieceNumber&) = default;
  };
  // A connected part of the frontier cells of one brick: what clusters are made of.
  struct Piece {
    BrickPlane cells{};
    std::vector<PieceNumber> touching;  // in other bricks
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
  std::vector<VoxelIndex> steps_;  // to the neighbours of a cell
  OccupancyMap::Revision revision_ = 0;
  std::size_t cell_count_ = 0;

  std::unordered_map<VoxelIndex, std::uint32_t> numbers_;  // of the bricks that hold frontier cells
  std::vector<BrickFrontier> bricks_;
  std::vector<std::uint32_t> unused_bricks_;
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> unused_clusters_;
};

}  // namespace vantage
