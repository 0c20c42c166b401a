// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/geometry/voxel_grid.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/raster_order.hpp>

namespace vantage {
namespace detail {

// Sorts in raster order. If the cells fill most of their bounding box, marking them in a grid is much faster than
// comparing them.
inline void sort(std::vector<VoxelIndex>& cells) {
  constexpr std::size_t kMostOfABox = 16;
  const VoxelBox box = detail::box_around(cells);
  if (box.size() > kMostOfABox * cells.size()) {
    std::sort(cells.begin(), cells.end(), RasterOrder{});
    return;
  }
  VoxelGrid<std::uint8_t> marked(box);
  for (const VoxelIndex& cell : cells) {
    if (marked[cell] != 0) {  // a duplicate, which the caller will report
      std::sort(cells.begin(), cells.end(), RasterOrder{});
      return;
    }
    marked[cell] = 1;
  }
  auto next = cells.begin();
  for_each_cell(box, [&](const VoxelIndex& cell) {
    if (marked[cell] != 0) {
      *next++ = cell;
    }
  });
}

inline std::string cell_text(const VoxelIndex& cell) {
  std::string text("(");
  return text.append(std::to_string(cell.x))
             .append(", ")
             .append(std::to_string(cell.y))
             .append(", ")
             .append(std::to_string(cell.z)) +
         ")";
}

}  // namespace detail

VANTAGE_INLINE LaplaceProblem::LaplaceProblem(std::vector<VoxelIndex> cells, std::span<const VoxelIndex> sinks,
                                              const VoxelIndex& source) {
  if (cells.size() >= static_cast<std::size_t>(std::numeric_limits<Position>::max())) {
    throw std::invalid_argument("LaplaceProblem: " + std::to_string(cells.size()) + " cells are too many");
  }
  detail::sort(cells);
  if (const auto twice = std::adjacent_find(cells.begin(), cells.end()); twice != cells.end()) {
    throw std::invalid_argument("LaplaceProblem: cell " + detail::cell_text(*twice) + " is given twice");
  }
  if (!std::binary_search(cells.begin(), cells.end(), source, RasterOrder{})) {
    throw std::invalid_argument("LaplaceProblem: the source " + detail::cell_text(source) +
                                " is not among the cells");
  }
  for (const VoxelIndex& sink : sinks) {
    if (sink == source || !std::binary_search(cells.begin(), cells.end(), sink, RasterOrder{})) {
      throw std::invalid_argument("LaplaceProblem: the sink " + detail::cell_text(sink) +
                                  (sink == source ? " is the source" : " is not among the cells"));
    }
  }

  keep_component(std::move(cells), source);
  kinds_.assign(cells_.size(), LaplaceCell::Interior);
  source_ = *position_of(source);
  kinds_[static_cast<std::size_t>(source_)] = LaplaceCell::Source;
  for (const VoxelIndex& sink : sinks) {
    const std::optional<Position> position = position_of(sink);
    if (position && kind(*position) == LaplaceCell::Interior) {
      kinds_[static_cast<std::size_t>(*position)] = LaplaceCell::Sink;
      ++sink_count_;
    }
  }
}

VANTAGE_INLINE std::optional<LaplaceProblem::Position> LaplaceProblem::position_of(const VoxelIndex& cell) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell, RasterOrder{});
  if (found == cells_.end() || *found != cell) {
    return std::nullopt;
  }
  return static_cast<Position>(found - cells_.begin());
}

// Keeps the component of the source, in sorted order.
VANTAGE_INLINE void LaplaceProblem::keep_component(std::vector<VoxelIndex> cells, const VoxelIndex& source) {
  cells_ = std::move(cells);
  link();
  // bytes instead of bits, because they are read six times per cell
  std::vector<std::uint8_t> joined(cells_.size(), 0);
  std::vector<Position> queue;
  queue.reserve(cells_.size());
  queue.push_back(*position_of(source));
  joined[static_cast<std::size_t>(queue.front())] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const Position neighbour : neighbours(queue[next])) {
      if (neighbour != kClosed && joined[static_cast<std::size_t>(neighbour)] == 0) {
        joined[static_cast<std::size_t>(neighbour)] = 1;
        queue.push_back(neighbour);
      }
    }
  }
  dropped_ = cells_.size() - queue.size();
  if (dropped_ > 0) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (joined[i] != 0) {
        cells_[kept++] = cells_[i];
      }
    }
    cells_.resize(kept);
    link();
  }
}

// Shifting all cells by the same step keeps their order. So one merge finds all neighbours in one direction and, at
// the same time, in the opposite direction.
VANTAGE_INLINE void LaplaceProblem::link() {
  std::array<Position, 6> closed{};
  closed.fill(kClosed);
  neighbours_.assign(cells_.size(), closed);
  for (std::size_t face = 1; face < kFaceNeighbours.size(); face += 2) {
    std::size_t candidate = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const VoxelIndex wanted = cells_[i] + kFaceNeighbours[face];
      while (candidate < cells_.size() && RasterOrder{}(cells_[candidate], wanted)) {
        ++candidate;
      }
      if (candidate < cells_.size() && cells_[candidate] == wanted) {
        neighbours_[i][face] = static_cast<Position>(candidate);
        neighbours_[candidate][face - 1] = static_cast<Position>(i);
      }
    }
  }
}

}  // namespace vantage
