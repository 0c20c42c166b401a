// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/robot/impl/block_ways.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vantage/geometry/raster_order.hpp>

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
  for_each_offset(cells, [&](std::size_t offset) {
    first = Brick::cell_at(brick, offset);
    sum_m += frame_.centre_of(first);
    ++count;
  });
  if (unused_.empty()) {
    unused_.push_back(static_cast<Piece>(pieces_.size()));
    pieces_.emplace_back();
  }
  const Piece number = unused_.back();
  unused_.pop_back();
  Piece& first_of_block = blocks_.place(block_of(first), kNone);
  pieces_[number] = {brick, block_of(first), cells, sum_m / static_cast<double>(count), first_of_block};
  first_of_block = number;
}

VANTAGE_INLINE void BlockWays::make_pieces(const Read& read) const {
  const auto add_pieces = [&](const BrickPlane& part) {
    for_each_piece(part, grown_through_faces, [&](const BrickPlane& piece) { add_piece(read.brick, piece); });
  };
  for (std::size_t word = 0; side_ == 4 && word < Brick::kWords; ++word) {
    BrickPlane part{};
    part[word] = read.cells[word];
    add_pieces(part);
  }
  if (side_ != 4) {
    add_pieces(read.cells);
  }
}

VANTAGE_INLINE BlockWays::Piece BlockWays::first_in(const VoxelIndex& block) const {
  const VoxelIndex brick = side_ == 4 ? VoxelIndex{block.x >> 1, block.y >> 1, block.z >> 1} : block;
  if (!std::exchange(bricks_.place(brick), true)) {
    read_.push_back({brick, cells_of_(brick)});
    make_pieces(read_.back());
  }
  const Piece* const first = blocks_.find(block);
  return first == nullptr ? kNone : *first;
}

template <class Visit>
void BlockWays::for_each_piece_of(const VoxelIndex& brick, Visit&& visit) const {
  const std::int32_t per_brick = Brick::kSide / side_;
  const VoxelIndex first{brick.x * per_brick, brick.y * per_brick, brick.z * per_brick};
  for_each_cell({first, first + VoxelIndex{per_brick, per_brick, per_brick}}, [&](const VoxelIndex& block) {
    if (Piece* const piece = blocks_.find(block)) {
      visit(*piece);
    }
  });
}

// A link depends on the cells of the blocks around its ends.
VANTAGE_INLINE void BlockWays::follow(CellsOf cells_of) {
  cells_of_ = std::move(cells_of);
  std::vector<VoxelIndex> touched;
  for (Read& read : read_) {
    const BrickPlane cells = cells_of_(read.brick);
    if (cells != read.cells) {
      read.cells = cells;
      for_each_piece_of(read.brick, [&](Piece& first) {
        for (; first != kNone; first = pieces_[first].next) {
          unused_.push_back(first);
        }
      });
      make_pieces(read);
      for_each_cell(VoxelBox{read.brick, read.brick + VoxelIndex{1, 1, 1}}.grown(1),
                    [&](const VoxelIndex& brick) { touched.push_back(brick); });
    }
  }
  sort_unique(touched);
  for (const VoxelIndex& brick : touched) {
    for_each_piece_of(brick, [&](Piece first) {
      for (; first != kNone; first = pieces_[first].next) {
        pieces_[first].beside = {};
        pieces_[first].links.reset();
      }
    });
  }
}

VANTAGE_INLINE const std::vector<BlockWays::Piece>& BlockWays::beside(Piece piece, std::size_t way) const {
  Node& node = pieces_[piece];
  if (!node.beside[way]) {
    std::vector<Piece>& beside = node.beside[way].emplace();
    for (Piece other = first_in(node.block + kFaceNeighbours[way]); other != kNone; other = pieces_[other].next) {
      const Node& lower = way % 2 == 1 ? node : pieces_[other];
      const Node& upper = way % 2 == 1 ? pieces_[other] : node;
      if (steps_up(lower.cells, upper.cells, lower.brick == upper.brick, kAxes[way / 2])) {
        beside.push_back(other);
      }
    }
    std::sort(beside.begin(), beside.end());
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
  const std::size_t offset = Brick::offset_of(cell);
  Piece piece = first_in(block_of(cell));
  while (piece != kNone && !has(pieces_[piece].cells, offset)) {
    piece = pieces_[piece].next;
  }
  return piece;
}

VANTAGE_INLINE std::vector<std::uint32_t> BlockWays::counted_by_piece(std::span<const VoxelIndex> cells) const {
  std::vector<std::uint32_t> counts;
  for (const VoxelIndex& cell : cells) {
    if (const Piece piece = piece_of(cell); piece != kNone) {  // may be a new piece
      counts.resize(std::max<std::size_t>(counts.size(), piece + 1), 0);
      ++counts[piece];
    }
  }
  return counts;
}

// From the piece of the cell on, the first link starts at the cell itself. `length_to` a wanted cell differs from the
// length of its piece by no more than a link. So the nearest are known once the search is two links behind the piece
// at which it has met enough of them. Pieces wait in buckets by their length (Dial 1969); within a bucket a piece may
// be met again with a shorter one.
VANTAGE_INLINE std::vector<double> BlockWays::lengths_from(const VoxelIndex& cell, std::span<const VoxelIndex> wanted,
                                                           std::size_t most) const {
  const Piece source = piece_of(cell);
  if (source == kNone) {
    return {};
  }
  const Eigen::Vector3d from_m = frame_.centre_of(cell);
  constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
  constexpr std::uint32_t kBucket = 256;
  const double longest_link_m = 3.5 * side_ * frame_.size_m;  // between cells of two blocks that touch
  const auto longest_link = static_cast<std::uint32_t>(std::ceil(longest_link_m / kUnitM));
  std::vector<std::uint32_t> goals_in = counted_by_piece(wanted);
  const auto goals = std::accumulate(goals_in.begin(), goals_in.end(), std::size_t{0});
  std::size_t left = wanted.empty() ? kFar : std::min(most, goals);
  std::uint32_t end = kFar;
  std::vector<std::uint32_t> best(pieces_.size(), kFar);
  using Entry = std::pair<std::uint32_t, Piece>;
  std::vector<std::vector<Entry>> buckets(longest_link / kBucket + 2);
  best[source] = 0;
  buckets.front().emplace_back(0U, source);
  std::size_t waiting = 1;
  for (std::uint32_t begin = 0; waiting > 0 && begin <= end; begin += kBucket) {
    std::vector<Entry>& bucket = buckets[begin / kBucket % buckets.size()];
    for (std::size_t next = 0; next < bucket.size(); ++next) {  // it grows
      const auto [length, piece] = bucket[next];
      --waiting;
      if (length != best[piece]) {
        continue;
      }
      if (piece < goals_in.size()) {
        left -= std::min<std::size_t>(left, std::exchange(goals_in[piece], 0));
      }
      const std::vector<Link>& around = links(piece);
      best.resize(pieces_.size(), kFar);
      for (const Link& link : around) {
        const std::uint32_t reached =
            piece == source ? units(from_m, pieces_[link.to].centre_m) : length + link.length;
        if (reached < best[link.to]) {
          best[link.to] = reached;
          buckets[reached / kBucket % buckets.size()].emplace_back(reached, link.to);
          ++waiting;
        }
      }
    }
    bucket.clear();
    end = left == 0 && end == kFar ? begin + kBucket + 2 * longest_link : end;
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

VANTAGE_INLINE VoxelIndex BlockWays::middle_of(const Node& piece) const {
  std::pair<double, VoxelIndex> nearest{kNoWay, {}};
  for_each_offset(piece.cells, [&](std::size_t offset) {
    const VoxelIndex cell = Brick::cell_at(piece.brick, offset);
    const double off_m2 = (frame_.centre_of(cell) - piece.centre_m).squaredNorm();
    nearest = off_m2 < nearest.first ? std::pair(off_m2, cell) : nearest;
  });
  return nearest.second;
}

// Goes from each piece to the next one on the way that gave it its length. That is nearer to `to`.
VANTAGE_INLINE std::vector<VoxelIndex> BlockWays::way(const VoxelIndex& from, const VoxelIndex& to) const {
  const std::vector<double> left = lengths_from(to, std::span(&from, 1), 1);
  if (length_to(from, to, left) == kNoWay) {
    return {};
  }
  const Piece last = piece_of(to);
  std::vector<VoxelIndex> cells{from};
  for (Piece at = piece_of(from); at != last;) {
    std::pair<double, double> least{kNoWay, kNoWay};  // with the link to it; without
    Piece next = last;
    for (const Link& link : links(at)) {
      const double beyond_m = link.to == last ? 0.0 : left.at(link.to);
      const double link_m =
          link.to == last ? (pieces_[at].centre_m - frame_.centre_of(to)).norm() : kUnitM * link.length;
      if (const std::pair length(link_m + beyond_m, beyond_m); length < least) {
        least = length;
        next = link.to;
      }
    }
    at = next;
    if (at != last) {
      cells.push_back(middle_of(pieces_[at]));
    }
  }
  cells.push_back(to);
  return cells;
}

}  // namespace vantage::detail
