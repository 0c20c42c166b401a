// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/disjoint_sets.hpp>
#include <vantage/geometry/raster_order.hpp>

namespace vantage {
namespace detail {

using Links = std::vector<std::array<std::uint32_t, 6>>;

// The number of set bits of a row. Baseline processors have no instruction for it.
inline std::uint32_t count_bits(std::uint32_t row) {
  row -= row >> 1U & 0x5555U;
  row = (row & 0x3333U) + (row >> 2U & 0x3333U);
  row = (row + (row >> 4U)) & 0x0F0FU;
  return (row + (row >> 8U)) & 0x1FU;
}

// Calls visit(first, last) for each run of set bits; both ends are included.
template <class Visit>
void for_each_run(std::uint32_t row, Visit&& visit) {
  while (row != 0) {
    const int first = std::countr_zero(row);
    const int length = std::countr_one(row >> first);
    visit(first, first + length - 1);
    row &= row + (1U << first);  // clears the lowest run; the carry may overflow at the top
  }
}

// Connected components of the domain, computed on runs of cells along x. There are ten times fewer runs than cells. A
// full brick counts as one run.
class RunComponents {
 public:
  RunComponents(const std::vector<LaplaceDomain::Brick>& bricks, const Links& links)
      : bricks_(bricks), first_run_(number_runs(bricks)), sets_(first_run_.back()) {
    for (std::size_t b = 0; b < bricks.size(); ++b) {
      for (std::size_t row = 0; row < LaplaceDomain::kRows; ++row) {
        join_row(b, row, links[b]);
      }
    }
  }

  [[nodiscard]] std::size_t component_of(std::size_t brick, std::size_t row, std::uint16_t bit) {
    const auto below = static_cast<std::uint16_t>(bit - 1U);
    return sets_.find(run_at(brick, row) +
                      starts_in(bricks_[brick].cells[row], static_cast<std::uint16_t>(below | bit)) - 1);
  }
  [[nodiscard]] std::size_t count() const { return sets_.count(); }
  // The cells of a row that belong to `component`.
  [[nodiscard]] std::uint16_t cells_of(std::size_t component, std::size_t brick, std::size_t row) {
    std::uint32_t kept = 0;
    std::size_t run = run_at(brick, row);
    for_each_run(bricks_[brick].cells[row], [&](int first, int last) {
      kept |= sets_.find(run++) == component ? (2U << last) - (1U << first) : 0U;
    });
    return static_cast<std::uint16_t>(kept);
  }

 private:
  static std::vector<std::uint32_t> number_runs(const std::vector<LaplaceDomain::Brick>& bricks) {
    std::vector<std::uint32_t> first_run{0};
    first_run.reserve(bricks.size() * LaplaceDomain::kRows + 1);
    for (const LaplaceDomain::Brick& brick : bricks) {
      if (is_full(brick)) {
        first_run.insert(first_run.end(), LaplaceDomain::kRows - 1, first_run.back());
        first_run.push_back(first_run.back() + 1);
        continue;
      }
      for (const std::uint16_t row : brick.cells) {
        first_run.push_back(first_run.back() + static_cast<std::uint32_t>(starts_in(row, 0xFFFF)));
      }
    }
    return first_run;
  }
  static bool is_full(const LaplaceDomain::Brick& brick) {
    return std::all_of(brick.cells.begin(), brick.cells.end(), [](std::uint16_t row) { return row == 0xFFFF; });
  }
  // The number of runs of `row` that start within `mask`, which must cover the lowest bits.
  static std::size_t starts_in(std::uint16_t row, std::uint16_t mask) {
    const std::uint32_t starts = row & ~(static_cast<std::uint32_t>(row) << 1U) & mask;
    return count_bits(starts);
  }
  [[nodiscard]] std::size_t run_at(std::size_t brick, std::size_t row) const {
    return first_run_[brick * LaplaceDomain::kRows + row];
  }

  // Joins the runs of a row with those of the previous rows in y and z, and across the lower x face of the brick. If
  // all four cells of a square belong to the domain, three of its sides already connect them, so the fourth is
  // skipped. Skipped are sides along z inside a brick if there are cells before them in y, and sides between bricks
  // if there are cells before them in y, or otherwise in z.
  void join_row(std::size_t b, std::size_t row, const std::array<std::uint32_t, 6>& links) {
    const std::uint16_t cells = bricks_[b].cells[row];
    if (cells == 0) {
      return;
    }
    const bool first_y = row % 8 == 0;
    const bool first_z = row < 8;
    if (links[0] != LaplaceDomain::kNone && meets_in_x(b, links[0], row) &&
        (first_y || !meets_in_x(b, links[0], row - 1))) {
      const std::uint16_t there = bricks_[links[0]].cells[row];
      sets_.merge(run_at(b, row), run_at(links[0], row) + starts_in(there, 0xFFFF) - 1);
    }
    if (!first_y) {
      join_rows(b, row, b, row - 1, 0);
    } else if (links[2] != LaplaceDomain::kNone) {
      join_rows(b, row, links[2], row + 7, first_z ? 0 : shared(b, row - 8, links[2], row - 1));
    }
    if (!first_z) {
      join_rows(b, row, b, row - 8, first_y ? 0 : shared(b, row - 1, b, row - 9));
    } else if (links[4] != LaplaceDomain::kNone) {
      join_rows(b, row, links[4], row + 56, first_y ? 0 : shared(b, row - 1, links[4], row + 55));
    }
  }
  // Whether a row continues in the adjacent lower brick along x.
  [[nodiscard]] bool meets_in_x(std::size_t b, std::size_t before, std::size_t row) const {
    return (bricks_[b].cells[row] & 1U) != 0 && (bricks_[before].cells[row] >> 15U) != 0;
  }
  [[nodiscard]] std::uint32_t shared(std::size_t brick_a, std::size_t row_a, std::size_t brick_b,
                                     std::size_t row_b) const {
    return static_cast<std::uint32_t>(bricks_[brick_a].cells[row_a] & bricks_[brick_b].cells[row_b]);
  }
  // Joins the runs that overlap in two rows. Skips overlaps with a cell in `joined`, because those runs are already
  // connected.
  void join_rows(std::size_t brick_a, std::size_t row_a, std::size_t brick_b, std::size_t row_b,
                 std::uint32_t joined) {
    const std::uint16_t a = bricks_[brick_a].cells[row_a];
    const std::uint16_t b = bricks_[brick_b].cells[row_b];
    for_each_run(shared(brick_a, row_a, brick_b, row_b), [&](int first, int last) {
      if ((joined & ((2U << last) - (1U << first))) != 0) {
        return;
      }
      const auto mask = static_cast<std::uint16_t>((2U << first) - 1U);
      sets_.merge(run_at(brick_a, row_a) + starts_in(a, mask) - 1, run_at(brick_b, row_b) + starts_in(b, mask) - 1);
    });
  }

  const std::vector<LaplaceDomain::Brick>& bricks_;
  std::vector<std::uint32_t> first_run_;
  DisjointSets sets_;
};

inline std::size_t count_bits(const std::array<std::uint16_t, LaplaceDomain::kRows>& rows) {
  return std::accumulate(rows.begin(), rows.end(), std::uint32_t{0},
                         [](std::uint32_t sum, std::uint16_t row) { return sum + count_bits(row); });
}

}  // namespace detail

VANTAGE_INLINE LaplaceDomain::LaplaceDomain(const LaplaceProblem& problem) {
  for (LaplaceProblem::Position position = 0; position < static_cast<LaplaceProblem::Position>(problem.size());
       ++position) {
    const VoxelIndex& cell = problem.cell(position);
    Brick& brick = brick_at(brick_of_cell(cell));
    brick.cells[row_of(cell)] |= bit_of(cell);
    brick.sinks[row_of(cell)] |= problem.kind(position) == LaplaceCell::Sink ? bit_of(cell) : std::uint16_t{0};
  }
}

VANTAGE_INLINE void LaplaceDomain::insert(const VoxelIndex& cell) {
  brick_at(brick_of_cell(cell)).cells[row_of(cell)] |= bit_of(cell);
}

VANTAGE_INLINE void LaplaceDomain::insert_sink(const VoxelIndex& cell) {
  Brick& brick = brick_at(brick_of_cell(cell));
  brick.cells[row_of(cell)] |= bit_of(cell);
  brick.sinks[row_of(cell)] |= bit_of(cell);
}

VANTAGE_INLINE LaplaceDomain::Brick& LaplaceDomain::brick_at(const VoxelIndex& address) {
  if (!bricks_.empty() && bricks_.back().address == address) {
    return bricks_.back();
  }
  const auto [found, is_new] = positions_.try_emplace(address, static_cast<std::uint32_t>(bricks_.size()));
  if (is_new) {
    bricks_.push_back({address, {}, {}});
  }
  return bricks_[found->second];
}

VANTAGE_INLINE bool LaplaceDomain::contains(const VoxelIndex& cell) const {
  const std::uint32_t position = position_of_brick(cell);
  return position != kNone && (bricks_[position].cells[row_of(cell)] & bit_of(cell)) != 0;
}

VANTAGE_INLINE bool LaplaceDomain::is_sink(const VoxelIndex& cell) const {
  const std::uint32_t position = position_of_brick(cell);
  return position != kNone && (bricks_[position].sinks[row_of(cell)] & bit_of(cell)) != 0;
}

// Four cells of a row of the map's sub-brick are adjacent in a row here.
VANTAGE_INLINE void LaplaceDomain::insert(const VoxelIndex& map_brick, const BrickPlane& cells,
                                          const BrickPlane& sinks) {
  if (cells == BrickPlane{}) {
    return;
  }
  Brick& brick = brick_at({map_brick.x >> 1, map_brick.y, map_brick.z});
  for (std::size_t word = 0; word < cells.size(); ++word) {
    const std::size_t shift = static_cast<std::size_t>(map_brick.x & 1) * 8 + (word & 1U) * 4;
    for (std::size_t line = 0; cells[word] != 0 && line < 16; ++line) {
      const std::size_t row = ((word >> 2U) * 4 + line / 4) * 8 + (word >> 1U & 1U) * 4 + line % 4;
      brick.cells[row] |= static_cast<std::uint16_t>((cells[word] >> (4 * line) & 15U) << shift);
      brick.sinks[row] |= static_cast<std::uint16_t>((sinks[word] >> (4 * line) & 15U) << shift);
    }
  }
}

VANTAGE_INLINE std::uint32_t LaplaceDomain::position_of_brick(const VoxelIndex& cell) const {
  const auto found = positions_.find(brick_of_cell(cell));
  return found == positions_.end() ? kNone : found->second;
}

VANTAGE_INLINE std::vector<std::array<std::uint32_t, 6>> LaplaceDomain::neighbours() const {
  detail::Links links(bricks_.size());
  for (std::size_t b = 0; b < bricks_.size(); ++b) {
    for (std::size_t face = 0; face < 6; ++face) {
      const auto found = positions_.find(bricks_[b].address + kFaceNeighbours[face]);
      links[b][face] = found == positions_.end() ? kNone : found->second;
    }
  }
  return links;
}

VANTAGE_INLINE std::size_t LaplaceDomain::cell_count() const {
  return std::accumulate(bricks_.begin(), bricks_.end(), std::size_t{0},
                         [](std::size_t sum, const Brick& brick) { return sum + detail::count_bits(brick.cells); });
}

VANTAGE_INLINE std::size_t LaplaceDomain::sink_count() const {
  return std::accumulate(bricks_.begin(), bricks_.end(), std::size_t{0},
                         [](std::size_t sum, const Brick& brick) { return sum + detail::count_bits(brick.sinks); });
}

VANTAGE_INLINE std::size_t LaplaceDomain::memory_bytes() const {
  constexpr std::size_t kHashNode = sizeof(VoxelIndex) + sizeof(std::uint32_t) + 2 * sizeof(void*);
  return bricks_.capacity() * sizeof(Brick) + positions_.size() * kHashNode +
         positions_.bucket_count() * sizeof(void*);
}

VANTAGE_INLINE LaplaceDomain::Dropped LaplaceDomain::keep_component(const VoxelIndex& cell) {
  if (!contains(cell)) {
    throw std::invalid_argument("LaplaceDomain: cell (" + std::to_string(cell.x) + ", " + std::to_string(cell.y) +
                                ", " + std::to_string(cell.z) + ") is not in the domain");
  }
  Dropped dropped;
  detail::RunComponents components(bricks_, neighbours());
  dropped.components = components.count() - 1;
  if (dropped.components > 0) {
    const std::size_t kept = components.component_of(position_of_brick(cell), row_of(cell), bit_of(cell));
    dropped.cells = cell_count();
    // Runs are numbered by the unchanged rows. So collect first, and write afterwards.
    std::vector<std::array<std::uint16_t, kRows>> cells(bricks_.size());
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
      for (std::size_t row = 0; row < kRows; ++row) {
        cells[b][row] = components.cells_of(kept, b, row);
      }
    }
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
      bricks_[b].cells = cells[b];
      for (std::size_t row = 0; row < kRows; ++row) {
        bricks_[b].sinks[row] &= cells[b][row];
      }
    }
    dropped.cells -= cell_count();
  }
  const std::size_t erased = std::erase_if(bricks_, [](const Brick& brick) {
    return std::all_of(brick.cells.begin(), brick.cells.end(), [](std::uint16_t row) { return row == 0; });
  });
  sort_bricks(erased > 0);
  return dropped;
}

// Sorts the bricks and rebuilds their positions. `have_gone`: bricks were erased, so the positions are invalid.
VANTAGE_INLINE void LaplaceDomain::sort_bricks(bool have_gone) {
  const auto before = [](const LaplaceDomain::Brick& a, const LaplaceDomain::Brick& b) {
    return RasterOrder{}(a.address, b.address);
  };
  if (!have_gone && std::is_sorted(bricks_.begin(), bricks_.end(), before)) {
    return;
  }
  std::sort(bricks_.begin(), bricks_.end(), before);
  positions_.clear();
  for (std::size_t b = 0; b < bricks_.size(); ++b) {
    positions_.emplace(bricks_[b].address, static_cast<std::uint32_t>(b));
  }
}

VANTAGE_INLINE LaplaceDomain known_free_domain(const OccupancyMap& map) {
  LaplaceDomain domain;
  map.for_each_brick([&](const VoxelIndex& address, const vantage::Brick& brick) {
    BrickPlane free{};
    for (std::size_t word = 0; word < free.size(); ++word) {
      free[word] = brick.free(word);
    }
    domain.insert(address, free, frontier_plane(map, address));
  });
  return domain;
}

}  // namespace vantage
