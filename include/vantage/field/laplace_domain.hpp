// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

class LaplaceProblem;

/// The cells of a Laplace problem (see LaplaceProblem), stored as bit planes in sparse bricks of 16 x 8 x 8 cells.
///
///     LaplaceDomain domain = known_free_domain(map);
///     LaplaceMultigrid field(std::move(domain), sensor_cell);
///
/// Memory and time grow with the number of bricks that hold a cell, not with the bounding box. A stored brick needs a
/// quarter of a byte per cell.
class LaplaceDomain {
 public:
  static constexpr VoxelIndex kBrickSides{16, 8, 8};  ///< cells of a brick along x, y, z
  static constexpr std::size_t kRows = 64;            ///< rows of a brick along x; the row index is z * 8 + y

  /// A brick. Bit x of row z * 8 + y is cell (x, y, z) of the brick.
  struct Brick {
    VoxelIndex address;                        ///< address in units of bricks
    std::array<std::uint16_t, kRows> cells{};  ///< the cells of the domain
    std::array<std::uint16_t, kRows> sinks{};  ///< the sinks, a subset of `cells`
  };
  /// Size of the components that were removed.
  struct Dropped {
    std::size_t cells = 0;       ///< number of cells, sinks included
    std::size_t components = 0;  ///< number of components
  };

  LaplaceDomain() = default;
  /// Copies the cells and sinks of a problem.
  explicit LaplaceDomain(const LaplaceProblem& problem);

  /// Adds a cell. No effect if the domain already holds it.
  void insert(const VoxelIndex& cell);
  /// Adds a cell, if necessary, and makes it a sink.
  void insert_sink(const VoxelIndex& cell);
  /// Adds cells of a brick of a map or of a BrickSet, and makes `sinks`, a subset of `cells`, sinks.
  void insert(const VoxelIndex& map_brick, const BrickPlane& cells, const BrickPlane& sinks = {});
  /// The brick at an address; an empty one is added if there is none. The reference is valid until another brick is
  /// added.
  [[nodiscard]] Brick& brick_at(const VoxelIndex& address);
  /// Whether the domain holds a cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const;
  /// Whether the domain holds a cell and the cell is a sink.
  [[nodiscard]] bool is_sink(const VoxelIndex& cell) const;

  /// All bricks, in the order in which they were added; in raster order after `keep_component`.
  [[nodiscard]] const std::vector<Brick>& bricks() const { return bricks_; }
  /// The positions in `bricks()` of the six neighbours of each brick, in the order of kFaceNeighbours; kNone if there
  /// is no neighbour.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 6>> neighbours() const;
  /// The position of a brick that does not exist.
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  /// Position in `bricks()` of the brick of a cell, or kNone.
  [[nodiscard]] std::uint32_t position_of_brick(const VoxelIndex& cell) const;

  /// Calls `visit(cell)` for each cell, sinks included, brick by brick; ordered by z, then y, then x within a brick.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    for_each(&Brick::cells, visit);
  }
  /// Calls `visit(cell)` for each sink in the same order.
  template <class Visit>
  void for_each_sink(Visit&& visit) const {
    for_each(&Brick::sinks, visit);
  }
  /// Number of cells, sinks included. Linear in the number of bricks.
  [[nodiscard]] std::size_t cell_count() const;
  /// Number of sinks. Linear in the number of bricks.
  [[nodiscard]] std::size_t sink_count() const;

  /// Memory in use in bytes, with an estimate for hash table nodes.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Removes all cells that are not connected to `cell` through faces, removes empty bricks, and sorts the bricks in
  /// raster order. Throws std::invalid_argument if `cell` is not in the domain.
  Dropped keep_component(const VoxelIndex& cell);

  /// The address of the brick that holds a cell.
  [[nodiscard]] static constexpr VoxelIndex brick_of_cell(const VoxelIndex& cell) {
    return {cell.x >> 4, cell.y >> 3, cell.z >> 3};
  }
  /// Row index of a cell within its brick.
  [[nodiscard]] static constexpr std::size_t row_of(const VoxelIndex& cell) {
    return static_cast<std::size_t>(cell.z & 7) * 8 + static_cast<std::size_t>(cell.y & 7);
  }
  /// Bit mask of a cell within its row.
  [[nodiscard]] static constexpr std::uint16_t bit_of(const VoxelIndex& cell) {
    return static_cast<std::uint16_t>(1U << static_cast<std::uint32_t>(cell.x & 15));
  }

 private:
  template <class Visit>
  void for_each(std::array<std::uint16_t, kRows> Brick::*plane, Visit& visit) const {
    for (const Brick& brick : bricks_) {
      const VoxelIndex first{brick.address.x * 16, brick.address.y * 8, brick.address.z * 8};
      for (std::int32_t row = 0; row < static_cast<std::int32_t>(kRows); ++row) {
        for (std::uint32_t left = (brick.*plane)[static_cast<std::size_t>(row)]; left != 0; left &= left - 1) {
          visit(first + VoxelIndex{std::countr_zero(left), row % 8, row / 8});
        }
      }
    }
  }
  void sort_bricks(bool have_gone);

  std::vector<Brick> bricks_;
  std::unordered_map<VoxelIndex, std::uint32_t> positions_;
};

/// The domain of all free cells of a map, with the frontier cells (frontiers.hpp) as sinks. It assumes a sensor
/// without a body.
[[nodiscard]] LaplaceDomain known_free_domain(const OccupancyMap& map);

/// The domain of all free cells of `region` in the map of a host, with its frontier cells as sinks.
template <OccupancyLookup Lookup>
[[nodiscard]] LaplaceDomain known_free_domain(const Lookup& lookup, const VoxelBox& region) {
  LaplaceDomain domain;
  for_each_cell(region, [&](const VoxelIndex& cell) {
    if (lookup.at(cell) == Occupancy::Free) {
      domain.insert(cell);
    }
  });
  for (const VoxelIndex& cell : frontier_cells(lookup, region)) {
    domain.insert_sink(cell);
  }
  return domain;
}

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/laplace_domain.ipp>
#endif
