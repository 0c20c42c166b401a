// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vantage/field/laplace_problem.hpp>

namespace vantage {
namespace {

bool before(const VoxelIndex& a, const VoxelIndex& b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); }

std::string text(const VoxelIndex& cell) {
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ", " + std::to_string(cell.z) + ")";
}

}  // namespace

LaplaceProblem::LaplaceProblem(std::vector<VoxelIndex> cells, std::span<const VoxelIndex> sinks,
                               const VoxelIndex& source) {
  if (cells.size() >= static_cast<std::size_t>(std::numeric_limits<Position>::max())) {
    throw std::invalid_argument("LaplaceProblem: " + std::to_string(cells.size()) + " cells are too many");
  }
  std::sort(cells.begin(), cells.end(), before);
  if (const auto twice = std::adjacent_find(cells.begin(), cells.end()); twice != cells.end()) {
    throw std::invalid_argument("LaplaceProblem: cell " + text(*twice) + " is given twice");
  }
  if (!std::binary_search(cells.begin(), cells.end(), source, before)) {
    throw std::invalid_argument("LaplaceProblem: the source " + text(source) + " is not among the cells");
  }
  for (const VoxelIndex& sink : sinks) {
    if (sink == source || !std::binary_search(cells.begin(), cells.end(), sink, before)) {
      throw std::invalid_argument("LaplaceProblem: the sink " + text(sink) +
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

std::optional<LaplaceProblem::Position> LaplaceProblem::position_of(const VoxelIndex& cell) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell, before);
  if (found == cells_.end() || *found != cell) {
    return std::nullopt;
  }
  return static_cast<Position>(found - cells_.begin());
}

// Keeps the component of the source, which stays sorted.
void LaplaceProblem::keep_component(std::vector<VoxelIndex> cells, const VoxelIndex& source) {
  cells_ = std::move(cells);
  link();
  std::vector<bool> joined(cells_.size(), false);
  std::vector<Position> queue{*position_of(source)};
  joined[static_cast<std::size_t>(queue.front())] = true;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const Position neighbour : neighbours(queue[next])) {
      if (neighbour != kClosed && !joined[static_cast<std::size_t>(neighbour)]) {
        joined[static_cast<std::size_t>(neighbour)] = true;
        queue.push_back(neighbour);
      }
    }
  }
  dropped_ = cells_.size() - queue.size();
  if (dropped_ > 0) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (joined[i]) {
        cells_[kept++] = cells_[i];
      }
    }
    cells_.resize(kept);
    link();
  }
}

// Shifting every cell by the same step keeps their order, so all neighbours in one direction are found in one merge.
void LaplaceProblem::link() {
  std::array<Position, 6> closed{};
  closed.fill(kClosed);
  neighbours_.assign(cells_.size(), closed);
  for (std::size_t face = 0; face < kFaceNeighbours.size(); ++face) {
    std::size_t candidate = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const VoxelIndex wanted = cells_[i] + kFaceNeighbours[face];
      while (candidate < cells_.size() && before(cells_[candidate], wanted)) {
        ++candidate;
      }
      if (candidate < cells_.size() && cells_[candidate] == wanted) {
        neighbours_[i][face] = static_cast<Position>(candidate);
      }
    }
  }
}

}  // namespace vantage
