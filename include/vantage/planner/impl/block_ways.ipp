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

VANTAGE_INLINE void BlockWays::add(const VoxelIndex& brick, const BrickPlane& cells) {
  const auto add_pieces = [&](const BrickPlane& part) {
    for_each_piece(part, grown_through_faces, [&](const BrickPlane& piece) { add_piece(brick, piece); });
  };
  if (side_ != 4) {
    add_pieces(cells);
    return;
  }
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    BrickPlane part{};
    part[word] = cells[word];
    add_pieces(part);
  }
}

VANTAGE_INLINE void BlockWays::add_piece(const VoxelIndex& brick, const BrickPlane& cells) {
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
  ++blocks_.place(block_of(first), {number, 0U}).second;
  pieces_.push_back({brick, cells, sum_m / static_cast<double>(count), {}});
}

VANTAGE_INLINE void BlockWays::link() {
  for (Piece piece = 0; piece < pieces_.size(); ++piece) {
    Node& node = pieces_[piece];
    const auto some = static_cast<std::size_t>(
        std::find_if(node.cells.begin(), node.cells.end(), [](std::uint64_t word) { return word != 0; }) -
        node.cells.begin());
    const VoxelIndex block = block_of(Brick::first_cell(node.brick) + Brick::cell_at(64 * some));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto* const next = blocks_.find(block + kFaceNeighbours[2 * axis + 1]);
      for (std::uint32_t i = 0; next != nullptr && i < next->second; ++i) {
        Node& other = pieces_[next->first + i];
        if (steps_up(node.cells, other.cells, node.brick == other.brick, kAxes[axis])) {
          node.beside[2 * axis + 1].push_back(next->first + i);
          other.beside[2 * axis].push_back(piece);
        }
      }
    }
  }
  for (Node& node : pieces_) {
    for (std::vector<Piece>& beside : node.beside) {
      std::sort(beside.begin(), beside.end());
    }
  }
  std::vector<Piece> linked;
  for (Piece piece = 0; piece < pieces_.size(); ++piece) {
    first_link_.push_back(static_cast<std::uint32_t>(links_.size()));
    linked.clear();
    link_all(piece, linked);
    for (const Piece to : linked) {
      links_.push_back({to, units(pieces_[piece].centre_m, pieces_[to].centre_m)});
    }
  }
  first_link_.push_back(static_cast<std::uint32_t>(links_.size()));
}

// The pieces beside any of `from` in a direction, sorted.
VANTAGE_INLINE std::vector<BlockWays::Piece> BlockWays::beyond(const std::vector<Piece>& from,
                                                               std::size_t way) const {
  std::vector<Piece> all;
  for (const Piece piece : from) {
    const std::vector<Piece>& beside = pieces_[piece].beside[way];
    all.insert(all.end(), beside.begin(), beside.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Through faces, edges and corners of the block.
VANTAGE_INLINE void BlockWays::link_all(Piece piece, std::vector<Piece>& linked) const {
  const auto& beside = pieces_[piece].beside;
  const auto take = [&](const std::vector<Piece>& pieces) {
    linked.insert(linked.end(), pieces.begin(), pieces.end());
  };
  const auto across = [&](std::size_t a, std::size_t b) {
    return beside[a].empty() || beside[b].empty() ? std::vector<Piece>{}
                                                  : in_both(beyond(beside[a], b), beyond(beside[b], a));
  };
  for (std::size_t x = 0; x < kWays; ++x) {
    take(beside[x]);
    for (std::size_t y = (x / 2 + 1) * 2; y < kWays; ++y) {
      const std::vector<Piece> edge = across(x, y);
      take(edge);
      for (std::size_t z = (y / 2 + 1) * 2; z < kWays && !edge.empty(); ++z) {
        take(in_both(in_both(beyond(edge, z), beyond(across(x, z), y)), beyond(across(y, z), x)));
      }
    }
  }
}

VANTAGE_INLINE BlockWays::Piece BlockWays::piece_of(const VoxelIndex& cell) const {
  const auto* const block = blocks_.find(block_of(cell));
  const std::size_t offset = Brick::offset_of(cell);
  for (std::uint32_t i = 0; block != nullptr && i < block->second; ++i) {
    if ((pieces_[block->first + i].cells[offset >> 6U] >> (offset & 63U) & 1U) != 0) {
      return block->first + i;
    }
  }
  return kNone;
}

// From the piece of the cell on, the first link starts at the cell itself.
VANTAGE_INLINE std::vector<double> BlockWays::lengths_from(const VoxelIndex& cell) const {
  std::vector<double> lengths(pieces_.size(), kNoWay);
  const Piece source = piece_of(cell);
  if (source == kNone) {
    return lengths;
  }
  const Eigen::Vector3d from_m = frame_.centre_of(cell);
  constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> best(pieces_.size(), kFar);
  using Entry = std::pair<std::uint32_t, Piece>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  best[source] = 0;
  open.emplace(0U, source);
  while (!open.empty()) {
    const auto [length, piece] = open.top();
    open.pop();
    if (length != best[piece]) {
      continue;
    }
    for (std::uint32_t i = first_link_[piece]; i < first_link_[piece + 1]; ++i) {
      const Link& link = links_[i];
      const std::uint32_t reached = piece == source ? units(from_m, pieces_[link.to].centre_m) : length + link.length;
      if (reached < best[link.to]) {
        best[link.to] = reached;
        open.emplace(reached, link.to);
      }
    }
  }
  for (std::size_t piece = 0; piece < best.size(); ++piece) {
    lengths[piece] = best[piece] == kFar ? kNoWay : kUnitM * best[piece];
  }
  lengths[source] = (pieces_[source].centre_m - from_m).norm();
  return lengths;
}

VANTAGE_INLINE double BlockWays::length_to(const VoxelIndex& cell, const VoxelIndex& from,
                                           const std::vector<double>& lengths) const {
  const Piece piece = piece_of(cell);
  if (piece == kNone || lengths[piece] == kNoWay) {
    return kNoWay;
  }
  const Eigen::Vector3d at_m = frame_.centre_of(cell);
  const double straight_m = (at_m - frame_.centre_of(from)).norm();
  if (piece == piece_of(from)) {
    return straight_m;
  }
  double shortest_m = kNoWay;
  const Piece source = piece_of(from);
  for (std::uint32_t i = first_link_[piece]; i < first_link_[piece + 1]; ++i) {
    const Piece last = links_[i].to;
    const double way_m = last == source ? straight_m : lengths[last] + (at_m - pieces_[last].centre_m).norm();
    shortest_m = std::min(shortest_m, way_m);
  }
  return std::max(straight_m, shortest_m);
}

}  // namespace vantage::detail
