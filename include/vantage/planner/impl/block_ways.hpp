// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vantage/geometry/voxel.hpp>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick.hpp>
#include <vector>

namespace vantage::detail {

/// Lengths of ways through a set of cells, computed on blocks of cells.
///
///     +---------+---------+     A block is divided into pieces: cells that are connected within it. Two pieces are
///     | 1 ### 2 | 2       |     linked if a step through a face leads from one to the other, so no way leaks through
///     | 1 ### 2-|-2       |     a wall one cell thick; diagonally, if both ways around the corner are linked.
///     +---------+---------+
///
/// Lengths are between the centroids of pieces, the ends of a way are exact: within a few per cent for ways of many
/// blocks.
class BlockWays {
 public:
  /// A piece by its number.
  using Piece = std::uint32_t;
  static constexpr Piece kNone = std::numeric_limits<Piece>::max();
  static constexpr double kNoWay = std::numeric_limits<double>::infinity();

  /// Blocks of `side` cells, 4 or 8.
  BlockWays(const VoxelFrame& frame, std::int32_t side) : frame_(frame), side_(side) {}

  /// Adds cells of a brick, each brick once, before `link`.
  void add(const VoxelIndex& brick, const BrickPlane& cells);
  /// Links the pieces that touch.
  void link();

  /// The number of pieces.
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }
  /// The piece that holds a cell, or kNone.
  [[nodiscard]] Piece piece_of(const VoxelIndex& cell) const;
  /// The cells of a piece.
  [[nodiscard]] const BrickPlane& cells_of(Piece piece) const { return pieces_[piece].cells; }
  /// The brick of a piece.
  [[nodiscard]] const VoxelIndex& brick_of(Piece piece) const { return pieces_[piece].brick; }
  /// The length of the way from the centre of `cell` to the centroid of each piece, metres; kNoWay if there is none.
  [[nodiscard]] std::vector<double> lengths_from(const VoxelIndex& cell) const;
  /// The length of the way to the centre of `cell`, by the result of `lengths_from(from)`.
  [[nodiscard]] double length_to(const VoxelIndex& cell, const VoxelIndex& from,
                                 const std::vector<double>& lengths) const;

 private:
  static constexpr std::size_t kWays = 6;  // the directions of kFaceNeighbours
  struct Node {
    VoxelIndex brick;
    BrickPlane cells;
    Eigen::Vector3d centre_m;
    std::array<std::vector<Piece>, kWays> beside;  // pieces that touch, by direction
  };
  struct Link {
    Piece to;
    std::uint32_t length;  // in units of kUnitM
  };
  static constexpr double kUnitM = 1e-3;

  [[nodiscard]] VoxelIndex block_of(const VoxelIndex& cell) const;
  [[nodiscard]] std::uint32_t units(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  void add_piece(const VoxelIndex& brick, const BrickPlane& cells);
  [[nodiscard]] std::vector<Piece> beyond(const std::vector<Piece>& from, std::size_t way) const;
  void link_all(Piece piece, std::vector<Piece>& linked) const;

  VoxelFrame frame_;
  std::int32_t side_;
  std::vector<Node> pieces_;                            // those of a block follow each other
  VoxelTable<std::pair<Piece, std::uint32_t>> blocks_;  // first piece and number of pieces
  std::vector<std::uint32_t> first_link_;               // by piece, and one past the last
  std::vector<Link> links_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/block_ways.ipp>
#endif
