// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a cell of a LaplaceProblem is held to.
enum class LaplaceCell : std::uint8_t {
  Interior,  ///< Laplace's equation holds
  Sink,      ///< phi = 0: a boundary to explore (Shade & Newman 2011, eq. 3)
  Source,    ///< phi = 1: the sensor's cell
};

/// The boundary value problem of Shade & Newman 2011, IV: find phi with zero Laplacian over a set of cells, 0 at the
/// sinks, 1 at the source, and no flow through any face behind which there is no cell of the set (eq. 4, 5).
///
///     const LaplaceProblem problem(std::move(reachable_cells), frontier_cells, sensor_cell);
///     const LaplaceSolution solution = relax_laplace(problem);
///
/// The domain is a list, so memory follows the number of cells and never their bounding box: each cell knows the
/// positions of its six neighbours in the list. Only the component of the source counts; other cells are dropped and
/// counted. A plane of cells makes the two-dimensional problem: the faces above and below are closed like any other.
class LaplaceProblem {
 public:
  /// Number of a cell of the problem, in [0, size()).
  using Position = std::int32_t;
  /// In place of a neighbour: there is none, the face is closed.
  static constexpr Position kClosed = -1;

  /// `cells` in any order, each once; `sinks` and `source` among them, `source` no sink. Throws std::invalid_argument
  /// naming what does not fit. There may be no sinks at all (phi is then 1 everywhere).
  LaplaceProblem(std::vector<VoxelIndex> cells, std::span<const VoxelIndex> sinks, const VoxelIndex& source);

  /// How many cells the problem has.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// The domain, ordered by z, then y, then x.
  [[nodiscard]] const std::vector<VoxelIndex>& cells() const { return cells_; }
  /// What the cell at this position is.
  [[nodiscard]] LaplaceCell kind(Position position) const { return kinds_[static_cast<std::size_t>(position)]; }
  /// Positions of the neighbours in the order of kFaceNeighbours, kClosed where the face is closed.
  [[nodiscard]] const std::array<Position, 6>& neighbours(Position position) const {
    return neighbours_[static_cast<std::size_t>(position)];
  }
  /// The cell at this position.
  [[nodiscard]] const VoxelIndex& cell(Position position) const { return cells_[static_cast<std::size_t>(position)]; }
  /// Where a cell is in the list; none if it is not in the domain. Logarithmic.
  [[nodiscard]] std::optional<Position> position_of(const VoxelIndex& cell) const;
  /// Position of the sensor's cell, where the potential is 1.
  [[nodiscard]] Position source() const { return source_; }
  /// How many frontier cells the problem has, where the potential is 0.
  [[nodiscard]] std::size_t sink_count() const { return sink_count_; }
  /// Cells given that are not joined to the source through faces.
  [[nodiscard]] std::size_t dropped_cells() const { return dropped_; }

 private:
  void keep_component(std::vector<VoxelIndex> cells, const VoxelIndex& source);
  void link();

  std::vector<VoxelIndex> cells_;
  std::vector<LaplaceCell> kinds_;
  std::vector<std::array<Position, 6>> neighbours_;
  Position source_ = 0;
  std::size_t sink_count_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace vantage
