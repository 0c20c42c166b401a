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

class LaplaceDomain;

/// The condition that a cell of a LaplaceProblem must satisfy.
enum class LaplaceCell : std::uint8_t {
  Interior,  ///< Laplace's equation
  Sink,      ///< phi = 0: a boundary to be explored (Shade & Newman 2011, eq. 3)
  Source,    ///< phi = 1: the cell of the sensor
};

/// A Laplace boundary value problem: find phi with zero Laplacian on a set of cells, phi = 0 at the sinks, phi = 1 at
/// the source, and zero flow through every closed face, that is a face without a cell of the set behind it.
///
///     const LaplaceProblem problem(reachable_cells, frontier_cells, sensor_cell);
///     const LaplaceSolution solution = relax_laplace(problem);
///
/// The domain is a list of cells, so memory grows with the number of cells and not with the bounding box. Each cell
/// stores the positions of its six neighbours in the list. Only the component of the source is kept; other cells are
/// dropped and counted. A single layer of cells gives the two-dimensional problem, because the faces above and below
/// are closed. (Shade & Newman 2011, IV, eq. 3-5.)
class LaplaceProblem {
 public:
  /// Index of a cell in the problem, in [0, size()).
  using Position = std::int32_t;
  /// Stands for a missing neighbour: the face is closed.
  static constexpr Position kClosed = -1;

  /// `cells` in any order, without duplicates. `sinks` and `source` must be among them, and `source` must not be a
  /// sink. Without sinks, phi is 1 everywhere. Throws std::invalid_argument, which names the cell at fault,
  /// otherwise.
  LaplaceProblem(const std::vector<VoxelIndex>& cells, std::span<const VoxelIndex> sinks, const VoxelIndex& source);
  /// The cells and sinks of `domain` that are connected to `source`; the others are counted (`dropped_cells`). Throws
  /// std::invalid_argument if `source` is not in the domain or is a sink.
  LaplaceProblem(LaplaceDomain domain, const VoxelIndex& source);

  /// The number of cells.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// The cells, ordered by z, then y, then x.
  [[nodiscard]] const std::vector<VoxelIndex>& cells() const { return cells_; }
  /// The condition of the cell at this position.
  [[nodiscard]] LaplaceCell kind(Position position) const { return kinds_[static_cast<std::size_t>(position)]; }
  /// Positions of the six neighbours in the order of kFaceNeighbours; kClosed at closed faces.
  [[nodiscard]] const std::array<Position, 6>& neighbours(Position position) const {
    return neighbours_[static_cast<std::size_t>(position)];
  }
  /// The cell at this position.
  [[nodiscard]] const VoxelIndex& cell(Position position) const { return cells_[static_cast<std::size_t>(position)]; }
  /// Position of a cell; nullopt if it is not in the domain. Logarithmic.
  [[nodiscard]] std::optional<Position> position_of(const VoxelIndex& cell) const;
  /// Position of the source cell.
  [[nodiscard]] Position source() const { return source_; }
  /// The number of sinks.
  [[nodiscard]] std::size_t sink_count() const { return sink_count_; }
  /// The number of given cells that are not connected to the source through faces.
  [[nodiscard]] std::size_t dropped_cells() const { return dropped_; }

 private:
  void link();

  std::vector<VoxelIndex> cells_;
  std::vector<LaplaceCell> kinds_;
  std::vector<std::array<Position, 6>> neighbours_;
  Position source_ = 0;
  std::size_t sink_count_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/laplace_problem.ipp>
#endif
