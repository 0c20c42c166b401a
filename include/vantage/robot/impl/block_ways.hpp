// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vantage/geometry/voxel.hpp>
#include <vantage/geometry/voxel_table.hpp>
#include <vantage/map/brick.hpp>
#include <vector>

namespace vantage::detail {

/// Lengths of routes (*ways*) through a set of cells, computed on blocks of cells.
///
///     +---------+---------+     A block is divided into pieces: cells that are connected within it. Two pieces are
///     | 1 ### 2 | 2       |     linked if a step through a face leads from one to the other, so no way leaks through
///     | 1 ### 2-|-2       |     a wall one cell thick; diagonally, if both ways around the corner are linked.
///     +---------+---------+
///
/// Lengths are between the centroids of pieces, but exact at both ends of a way. They are off by a few per cent for
/// ways of many blocks. Pieces and links are made where a search first reaches them, and kept until the set changes
/// beside them. So the cost follows the searches and the changes, not the set. The lengths depend only on the set as
/// it is, not on what was kept.
class BlockWays {
 public:
  /// A piece by its number.
  using Piece = std::uint32_t;
  static constexpr Piece kNone = std::numeric_limits<Piece>::max();
  static constexpr double kNoWay = std::numeric_limits<double>::infinity();

  /// The cells of the set in a brick.
  using CellsOf = std::function<BrickPlane(const VoxelIndex&)>;

  /// Ways through nothing, on blocks of `side` cells, 4 or 8.
  BlockWays(const VoxelFrame& frame, std::int32_t side) : frame_(frame), side_(side) {}

  /// Ways through the set as it is now, which must neither change nor end before the next call.
  void follow(CellsOf cells_of);

  /// The frame of the cells.
  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  /// The number of pieces that are kept.
  [[nodiscard]] std::size_t size() const { return pieces_.size() - unused_.size(); }
  /// The piece that holds a cell, or kNone.
  [[nodiscard]] Piece piece_of(const VoxelIndex& cell) const;
  /// The cells of a piece.
  [[nodiscard]] const BrickPlane& cells_of(Piece piece) const { return pieces_[piece].cells; }
  /// The brick of a piece.
  [[nodiscard]] const VoxelIndex& brick_of(Piece piece) const { return pieces_[piece].brick; }
  /// The length of the way from the centre of `cell` to the centroid of each piece, metres; kNoWay if there is none.
  /// If cells are wanted, the search ends once `length_to` the nearest `most` of them is known; pieces further away
  /// then have kNoWay.
  [[nodiscard]] std::vector<double> lengths_from(const VoxelIndex& cell, std::span<const VoxelIndex> wanted = {},
                                                 std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// The length of the way to the centre of `cell`, by the result of `lengths_from(from)`.
  [[nodiscard]] double length_to(const VoxelIndex& cell, const VoxelIndex& from,
                                 const std::vector<double>& lengths) const;
  /// A way from cell to cell: both, and between them the middle cell of each piece on the way. Empty if there is
  /// none.
  [[nodiscard]] std::vector<VoxelIndex> way(const VoxelIndex& from, const VoxelIndex& to) const;

 private:
  static constexpr std::size_t kWays = 6;  // the directions of kFaceNeighbours
  struct Link {
    Piece to;
    std::uint32_t length;  // in units of kUnitM
  };
  struct Node {
    VoxelIndex brick;
    VoxelIndex block;
    BrickPlane cells;
    Eigen::Vector3d centre_m;
    Piece next;                                                        // of the same block, or kNone
    std::array<std::optional<std::vector<Piece>>, kWays> beside = {};  // pieces that touch, ascending, by direction
    std::optional<std::vector<Link>> links = {};
  };
  // A brick that was read.
  struct Read {
    VoxelIndex brick;
    BrickPlane cells;
  };
  static constexpr double kUnitM = 1e-3;

  [[nodiscard]] VoxelIndex block_of(const VoxelIndex& cell) const;
  [[nodiscard]] std::uint32_t units(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  void add_piece(const VoxelIndex& brick, const BrickPlane& cells) const;
  void make_pieces(const Read& read) const;
  [[nodiscard]] Piece first_in(const VoxelIndex& block) const;
  // The cell nearest to the centroid.
  [[nodiscard]] VoxelIndex middle_of(const Node& piece) const;
  // How many of these cells each piece holds.
  [[nodiscard]] std::vector<std::uint32_t> counted_by_piece(std::span<const VoxelIndex> cells) const;
  template <class Visit>
  void for_each_piece_of(const VoxelIndex& brick, Visit&& visit) const;
  [[nodiscard]] const std::vector<Piece>& beside(Piece piece, std::size_t way) const;
  [[nodiscard]] std::vector<Piece> beyond(const std::vector<Piece>& from, std::size_t way) const;
  [[nodiscard]] std::vector<Piece> all_around(Piece piece) const;
  [[nodiscard]] const std::vector<Link>& links(Piece piece) const;

  VoxelFrame frame_;
  std::int32_t side_;
  CellsOf cells_of_;
  mutable std::deque<Node> pieces_;
  mutable std::vector<Piece> unused_;  // numbers of pieces that are no more
  mutable VoxelTable<Piece> blocks_;   // the first piece of each
  mutable VoxelTable<bool> bricks_;    // in read_
  mutable std::deque<Read> read_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/block_ways.ipp>
#endif
