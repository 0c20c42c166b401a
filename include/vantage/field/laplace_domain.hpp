// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The cells of a boundary value problem (see LaplaceProblem) as bit planes in sparse bricks of 16 x 8 x 8 cells.
///
///     LaplaceDomain domain = known_free_domain(map);
///     LaplaceMultigrid field(std::move(domain), sensor_cell);
///
/// Memory and time follow the bricks that hold a cell, never their bounding box: a quarter of a byte per cell of
/// those.
class LaplaceDomain {
 public:
  static constexpr VoxelIndex kBrickSides{16, 8, 8};  ///< cells of a brick along x, y, z
  static constexpr std::size_t kRows = 64;            ///< rows of a brick along x: y runs faster than z

  /// A brick; bit x of a row is the cell at x, row z * 8 + y.
  struct Brick {
    VoxelIndex address;                        ///< in units of bricks
    std::array<std::uint16_t, kRows> cells{};  ///< what belongs to the domain
    std::array<std::uint16_t, kRows> sinks{};  ///< a subset of `cells`
  };
  /// Components that were left out.
  struct Dropped {
    std::size_t cells = 0;       ///< their cells, sinks included
    std::size_t components = 0;  ///< how many there were
  };

  LaplaceDomain() = default;
  /// The same cells and sinks.
  explicit LaplaceDomain(const LaplaceProblem& problem);

  /// Adds a cell; nothing changes if it is there already.
  void insert(const VoxelIndex& cell);
  /// Adds a cell, if need be, and makes it a sink.
  void insert_sink(const VoxelIndex& cell);
  /// The brick at an address, made empty if it was not there. Valid until the next call that adds a brick.
  [[nodiscard]] Brick& brick_at(const VoxelIndex& address);
  /// Whether the cell belongs to the domain.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const;

  /// Its bricks: in the order they came, or in raster order after `keep_component`.
  [[nodiscard]] const std::vector<Brick>& bricks() const { return bricks_; }
  /// For each brick the positions of its neighbours in `bricks()`, in the order of kFaceNeighbours; kNone for none.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 6>> neighbours() const;
  /// In place of a position: no brick.
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  /// Position of the brick of a cell, or kNone.
  [[nodiscard]] std::uint32_t position_of_brick(const VoxelIndex& cell) const;

  /// Cells, sinks included; counts them.
  [[nodiscard]] std::size_t cell_count() const;
  /// Sinks; counts them.
  [[nodiscard]] std::size_t sink_count() const;

  /// Bytes held, an estimate of the hash nodes included.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Keeps the component of `cell`, joined through faces, and the bricks it lies in, in raster order. Throws
  /// std::invalid_argument if the cell is not in the domain.
  Dropped keep_component(const VoxelIndex& cell);

  /// The brick that holds a cell.
  [[nodiscard]] static constexpr VoxelIndex brick_of_cell(const VoxelIndex& cell) {
    return {cell.x >> 4, cell.y >> 3, cell.z >> 3};
  }
  /// Row of a cell within its brick.
  [[nodiscard]] static constexpr std::size_t row_of(const VoxelIndex& cell) {
    return static_cast<std::size_t>(cell.z & 7) * 8 + static_cast<std::size_t>(cell.y & 7);
  }
  /// Bit of a cell within its row.
  [[nodiscard]] static constexpr std::uint16_t bit_of(const VoxelIndex& cell) {
    return static_cast<std::uint16_t>(1U << static_cast<std::uint32_t>(cell.x & 15));
  }

 private:
  void sort_bricks(bool have_gone);

  std::vector<Brick> bricks_;
  std::unordered_map<VoxelIndex, std::uint32_t> positions_;
};

/// All free cells of a map, its frontier cells (frontiers.hpp) as sinks: the problem of a sensor without a body.
[[nodiscard]] LaplaceDomain known_free_domain(const OccupancyMap& map);

}  // namespace vantage
