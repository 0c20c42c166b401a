// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/block_ways.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage::detail {

// Whether a step up along an axis leads from a cell of `lower` to one of `upper`, the planes of two bricks, or of the
// same.
inline bool steps_up(const BrickPlane& lower, const BrickPlane& upper, bool same_brick, const Axis& axis) {
  constexpr BrickPlane kNothing{};
  std::uint64_t met = 0;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    met |= upper[word] & from_below(same_brick ? lower : kNothing, same_brick ? kNothing : lower, axis, word);
  }
  return met != 0;
}

inline std::vector<BlockWays::Piece> in_both(std::vector<BlockWays::Piece> a, std::vector<BlockWays::Piece> b) {
  std::vector<BlockWays::Piece> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

VANTAGE_INLINE VoxelIndex BlockWays::block_of(const VoxelIndex& cell) const {
  return side_ == 4 ? VoxelIndex{cell.x >> 2, cell.y >> 2, cell.z >> 2} : Brick::of_cell(cell);
}

VANTAGE_INLINE std::uint32_t BlockWays::units(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  return static_cast<std::uint32_t>(std::lround((a - b).norm() / kUnitM));
}

VANTAGE_INLINE void BlockWays::add_piece(const VoxelIndex& brick, const BrickPlane& cells) const {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  VoxelIndex first;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    for_each_offset(cells[word], word, [&](std::size_t offset) {
      first = Brick::first_cell(brick) + Brick::cell_at(offset);
      sum_m += frame_.centre_of(first);
      ++count;
    });
  }
  const auto number = static_cast<Piece>(pieces_.size());
  ++blocks_.place(block_of(first), {number, 0U}).size;
  pieces_.push_back({brick, block_of(first), cells, sum_m / static_cast<double>(count)});
}

VANTAGE_INLINE BlockWays::Block BlockWays::pieces_in(const VoxelIndex& block) const {
  const VoxelIndex brick = side_ == 4 ? VoxelIndex{block.x >> 1, block.y >> 1, block.z >> 1} : block;
  if (!std::exchange(bricks_.place(brick), true)) {
    const BrickPlane cells = cells_of_(brick);
    const auto add_pieces = [&](const BrickPlane& part) {
      for_each_piece(part, grown_through_faces, [&](const BrickPlane& piece) { add_piece(brick, piece); });
    };
    for (std::size_t word = 0; side_ == 4 && word < Brick::kWords; ++word) {
      BrickPlane part{};
      part[word] = cells[word];
      add_pieces(part);
    }
    if (side_ != 4) {
      add_pieces(cells);
    }
  }
  const Block* const pieces = blocks_.find(block);
  return pieces == nullptr ? Block{0, 0} : *pieces;
}

VANTAGE_INLINE const std::vector<BlockWays::Piece>& BlockWays::beside(Piece piece, std::size_t way) const {
  Node& node = pieces_[piece];
  if (!node.beside[way]) {
    std::vector<Piece>& beside = node.beside[way].emplace();
    const Block next = pieces_in(node.block + kFaceNeighbours[way]);
    for (Piece other = next.first; other < next.first + next.size; ++other) {
      const Node& lower = way % 2 == 1 ? node : pieces_[other];
      const Node& upper = way % 2 == 1 ? pieces_[other] : node;
      if (steps_up(lower.cells, upper.cells, lower.brick == upper.brick, kAxes[way / 2])) {
        beside.push_back(other);
      }
    }
  }
  return *node.beside[way];
}

// The pieces beside any of `from` in a direction, sorted.
VANTAGE_INLINE std::vector<BlockWays::Piece> BlockWays::beyond(const std::vector<Piece>& from,
                                                               std::size_t way) const {
  std::vector<Piece> all;
  for (const Piece piece : from) {
    const std::vector<Piece>& found = beside(piece, way);
    all.insert(all.end(), found.begin(), found.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Through faces, edges and corners of the block.
VANTAGE_INLINE std::vector<BlockWays::Piece> BlockWays::all_around(Piece piece) const {
  std::vector<Piece> around;
  const auto take = [&](const std::vector<Piece>& pieces) {
    around.insert(around.end(), pieces.begin(), pieces.end());
  };
  const auto across = [&](std::size_t a, std::size_t b) {
    const std::vector<Piece>& on_a = beside(piece, a);
    const std::vector<Piece>& on_b = beside(piece, b);
    return on_a.empty() || on_b.empty() ? std::vector<Piece>{} : in_both(beyond(on_a, b), beyond(on_b, a));
  };
  for (std::size_t x = 0; x < kWays; ++x) {
    take(beside(piece, x));
    for (std::size_t y = (x / 2 + 1) * 2; y < kWays; ++y) {
      const std::vector<Piece> edge = across(x, y);
      take(edge);
      for (std::size_t z = (y / 2 + 1) * 2; z < kWays && !edge.empty(); ++z) {
        take(in_both(in_both(beyond(edge, z), beyond(across(x, z), y)), beyond(across(y, z), x)));
      }
    }
  }
  return around;
}

VANTAGE_INLINE const std::vector<BlockWays::Link>& BlockWays::links(Piece piece) const {
  if (!pieces_[piece].links) {
    std::vector<Link> links;
    for (const Piece to : all_around(piece)) {
      links.push_back({to, units(pieces_[piece].centre_m, pieces_[to].centre_m)});
    }
    pieces_[piece].links = std::move(links);
  }
  return *pieces_[piece].links;
}

VANTAGE_INLINE BlockWays::Piece BlockWays::piece_of(const VoxelIndex& cell) const {
  const Block block = pieces_in(block_of(cell));
  const std::size_t offset = Brick::offset_of(cell);
  for (Piece piece = block.first; piece < block.first + block.size; ++piece) {
    if ((pieces_[piece].cells[offset >> 6U] >> (offset & 63U) & 1U) != 0) {
      return piece;
    }
  }
  return kNone;
}

// From the piece of the cell on, the first link starts at the cell itself. `length_to` a wanted cell differs from the
// length of its piece by no more than a link. So the nearest are known once the search is two links behind the piece
// at which it has met enough of them.
VANTAGE_INLINE std::vector<double> BlockWays::lengths_from(const VoxelIndex& cell, std::span<const VoxelIndex> wanted,
                                                           std::size_t most) const {
  const Piece source = piece_of(cell);
  if (source == kNone) {
    return {};
  }
  const Eigen::Vector3d from_m = frame_.centre_of(cell);
  constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
  const double longest_link_m = 3.5 * side_ * frame_.size_m;  // between cells of two blocks that touch
  const auto behind = static_cast<std::uint32_t>(std::ceil(2.0 * longest_link_m / kUnitM));
  std::vector<Piece> goals;
  for (const VoxelIndex& goal : wanted) {
    goals.push_back(piece_of(goal));
  }
  std::sort(goals.begin(), goals.end());
  std::size_t left = wanted.empty() ? kFar : std::min(most, wanted.size());
  std::uint32_t end = kFar;
  std::vector<std::uint32_t> best(pieces_.size(), kFar);
  using Entry = std::pair<std::uint32_t, Piece>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  best[source] = 0;
  open.emplace(0U, source);
  while (!open.empty() && open.top().first <= end) {
    const auto [length, piece] = open.top();
    open.pop();
    if (length != best[piece]) {
      continue;
    }
    const auto [first, last] = std::equal_range(goals.begin(), goals.end(), piece);
    left -= std::min(left, static_cast<std::size_t>(last - first));
    end = left == 0 && end == kFar ? length + behind : end;
    const std::vector<Link>& around = links(piece);
    best.resize(pieces_.size(), kFar);
    for (const Link& link : around) {
      const std::uint32_t reached = piece == source ? units(from_m, pieces_[link.to].centre_m) : length + link.length;
      if (reached < best[link.to]) {
        best[link.to] = reached;
        open.emplace(reached, link.to);
      }
    }
  }
  std::vector<double> lengths(best.size(), kNoWay);
  for (std::size_t piece = 0; piece < best.size(); ++piece) {
    if (best[piece] != kFar && best[piece] <= end) {
      lengths[piece] = kUnitM * best[piece];
    }
  }
  lengths[source] = (pieces_[source].centre_m - from_m).norm();
  return lengths;
}

VANTAGE_INLINE double BlockWays::length_to(const VoxelIndex& cell, const VoxelIndex& from,
                                           const std::vector<double>& lengths) const {
  const Piece piece = piece_of(cell);
  if (piece >= lengths.size() || lengths[piece] == kNoWay) {
    return kNoWay;
  }
  const Eigen::Vector3d at_m = frame_.centre_of(cell);
  const double straight_m = (at_m - frame_.centre_of(from)).norm();
  const Piece source = piece_of(from);
  if (piece == source) {
    return straight_m;
  }
  double shortest_m = kNoWay;
  for (const Link& link : links(piece)) {
    if (link.to == source) {
      shortest_m = std::min(shortest_m, straight_m);
    } else if (link.to < lengths.size()) {
      shortest_m = std::min(shortest_m, lengths[link.to] + (at_m - pieces_[link.to].centre_m).norm());
    }
  }
  return std::max(straight_m, shortest_m);
}

}  // namespace vantage::detail
