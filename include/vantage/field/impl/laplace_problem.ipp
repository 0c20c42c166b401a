// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vantage/field/laplace_domain.hpp>
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

inline LaplaceDomain domain_of(const std::vector<VoxelIndex>& cells, std::span<const VoxelIndex> sinks,
                               const VoxelIndex& source) {
  LaplaceDomain domain;
  for (const VoxelIndex& cell : cells) {
    if (domain.contains(cell)) {
      throw std::invalid_argument("LaplaceProblem: cell " + cell_text(cell) + " is given twice");
    }
    domain.insert(cell);
  }
  for (const VoxelIndex& sink : sinks) {
    if (sink == source || !domain.contains(sink)) {
      throw std::invalid_argument("LaplaceProblem: the sink " + cell_text(sink) +
                                  (sink == source ? " is the source" : " is not among the cells"));
    }
    domain.insert_sink(sink);
  }
  return domain;
}

}  // namespace detail

VANTAGE_INLINE LaplaceProblem::LaplaceProblem(const std::vector<VoxelIndex>& cells, std::span<const VoxelIndex> sinks,
                                              const VoxelIndex& source)
    : LaplaceProblem(detail::domain_of(cells, sinks, source), source) {}

VANTAGE_INLINE LaplaceProblem::LaplaceProblem(LaplaceDomain domain, const VoxelIndex& source)
    : dropped_(domain.keep_component(source).cells) {
  if (domain.is_sink(source)) {
    throw std::invalid_argument("LaplaceProblem: the source " + detail::cell_text(source) + " is a sink");
  }
  const std::size_t size = domain.cell_count();
  if (size >= static_cast<std::size_t>(std::numeric_limits<Position>::max())) {
    throw std::invalid_argument("LaplaceProblem: " + std::to_string(size) + " cells are too many");
  }
  cells_.reserve(size);
  domain.for_each_cell([&](const VoxelIndex& cell) { cells_.push_back(cell); });
  detail::sort(cells_);
  link();
  kinds_.assign(size, LaplaceCell::Interior);
  source_ = *position_of(source);
  kinds_[static_cast<std::size_t>(source_)] = LaplaceCell::Source;
  domain.for_each_sink([&](const VoxelIndex& sink) {
    kinds_[static_cast<std::size_t>(*position_of(sink))] = LaplaceCell::Sink;
    ++sink_count_;
  });
}

VANTAGE_INLINE std::optional<LaplaceProblem::Position> LaplaceProblem::position_of(const VoxelIndex& cell) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell, RasterOrder{});
  if (found == cells_.end() || *found != cell) {
    return std::nullopt;
  }
  return static_cast<Position>(found - cells_.begin());
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
