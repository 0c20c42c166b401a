// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <utility>
#include <vantage/frontier/frontier_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage {
namespace detail {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

inline void join(BrickPlane& plane, const BrickPlane& other) {
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    plane[word] |= other[word];
  }
}

inline BrickPlane grown(const BrickPlane& plane, Connectivity connectivity) {
  if (connectivity == Connectivity::Face6) {
    return detail::grown_through_faces(plane);
  }
  BrickPlane result = plane;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (connectivity == Connectivity::Edge18) {
      const BrickPlane along = detail::grown_along(plane, detail::kAxes[axis]);
      join(result, detail::grown_along(along, detail::kAxes[(axis + 1) % 3]));
    } else {
      result = detail::grown_along(result, detail::kAxes[axis]);
    }
  }
  return result;
}

// The cells on the surface of a brick. Only they have neighbours in other bricks.
inline constexpr BrickPlane kShell = [] {
  BrickPlane shell{};
  for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
    const VoxelIndex cell = Brick::cell_at(offset);
    const auto outermost = [](std::int32_t at) { return at == 0 || at == Brick::kSide - 1; };
    if (outermost(cell.x) || outermost(cell.y) || outermost(cell.z)) {
      shell[offset / 64] |= std::uint64_t{1} << (offset % 64);
    }
  }
  return shell;
}();

// Offsets to the neighbours of a cell.
inline std::vector<VoxelIndex> steps_of(Connectivity connectivity) {
  const int most = connectivity == Connectivity::Face6 ? 1 : connectivity == Connectivity::Edge18 ? 2 : 3;
  std::vector<VoxelIndex> steps;
  std::copy_if(kAllNeighbours.begin(), kAllNeighbours.end(), std::back_inserter(steps),
               [most](const VoxelIndex& s) { return std::abs(s.x) + std::abs(s.y) + std::abs(s.z) <= most; });
  return steps;
}

}  // namespace detail

VANTAGE_INLINE FrontierTracker::FrontierTracker(const OccupancyMap& map, Connectivity connectivity)
    : map_(&map), connectivity_(connectivity), steps_(detail::steps_of(connectivity)) {
  update();
}

VANTAGE_INLINE std::size_t FrontierTracker::update() {
  // The frontier of a brick depends only on the brick and its face neighbours.
  std::vector<VoxelIndex> touched = map_->changed_since(revision_);
  revision_ = map_->revision();
  for (std::size_t i = touched.size(); i-- > 0;) {
    const VoxelIndex brick = touched[i];
    for (const VoxelIndex& step : kFaceNeighbours) {
      touched.push_back(brick + step);
    }
  }
  sort_unique(touched);

  std::vector<Change> changes;
  for (const VoxelIndex& address : touched) {
    const auto known = numbers_.find(address);
    const BrickPlane now = frontier_plane(*map_, address);
    if (now != (known == numbers_.end() ? BrickPlane{} : bricks_[known->second].cells)) {
      changes.push_back({address, now});
    }
  }
  regroup(changes);
  return changes.size();
}

// Dissolves the clusters that the changes touch, then regroups their pieces.
VANTAGE_INLINE void FrontierTracker::regroup(const std::vector<Change>& changes) {
  std::vector<PieceNumber> loose;
  for (const Change& change : changes) {
    if (const auto known = numbers_.find(change.brick); known != numbers_.end()) {
      for (const Piece& piece : bricks_[known->second].pieces) {
        dissolve(piece.cluster, loose);
      }
      unlink(known->second);
    }
  }
  const std::size_t old = loose.size();
  for (const Change& change : changes) {
    replace(change, loose);
  }
  for (std::size_t i = old; i < loose.size(); ++i) {
    link(loose[i]);
  }
  // The list may name pieces of replaced bricks that no longer exist. A new piece at the same index needs a cluster
  // too.
  for (const PieceNumber& number : loose) {
    if (number.piece < bricks_[number.brick].pieces.size() && at(number).cluster == detail::kNone) {
      gather(number);
    }
  }
}

VANTAGE_INLINE void FrontierTracker::dissolve(std::uint32_t cluster, std::vector<PieceNumber>& loose) {
  if (cluster == detail::kNone) {
    return;
  }
  for (const PieceNumber& number : clusters_[cluster].pieces) {
    at(number).cluster = detail::kNone;
    loose.push_back(number);
  }
  clusters_[cluster] = {};
  unused_clusters_.push_back(cluster);
}

// Removes the references to the pieces of a brick from the adjacent pieces.
VANTAGE_INLINE void FrontierTracker::unlink(std::uint32_t brick) {
  for (const Piece& piece : bricks_[brick].pieces) {
    for (const PieceNumber& other : piece.touching) {
      std::erase_if(at(other).touching, [brick](const PieceNumber& one) { return one.brick == brick; });
    }
  }
}

VANTAGE_INLINE void FrontierTracker::replace(const Change& change, std::vector<PieceNumber>& loose) {
  const auto [known, is_new] = numbers_.try_emplace(change.brick, static_cast<std::uint32_t>(bricks_.size()));
  if (is_new && !unused_bricks_.empty()) {
    known->second = unused_bricks_.back();
    unused_bricks_.pop_back();
  } else if (is_new) {
    bricks_.emplace_back();
  }
  const std::uint32_t number = known->second;
  BrickFrontier& brick = bricks_[number];
  cell_count_ += detail::size_of(change.cells) - detail::size_of(brick.cells);
  brick = {change.brick, change.cells, {}};
  detail::for_each_piece(
      change.cells, [this](const BrickPlane& piece) { return detail::grown(piece, connectivity_); },
      [&](const BrickPlane& piece) {
        loose.push_back({number, static_cast<std::uint32_t>(brick.pieces.size())});
        brick.pieces.push_back({piece, {}, detail::kNone});
      });
  if (brick.pieces.empty()) {
    unused_bricks_.push_back(number);
    numbers_.erase(known);
  }
}

// Connects a new piece with the pieces adjacent to it, unless they are connected already.
VANTAGE_INLINE void FrontierTracker::link(const PieceNumber& number) {
  for (const PieceNumber& other : neighbours(number)) {
    std::vector<PieceNumber>& touching = at(other).touching;
    if (std::find(touching.begin(), touching.end(), number) == touching.end()) {
      touching.push_back(number);
      at(number).touching.push_back(other);
    }
  }
}

// Grows a cluster from a piece without a cluster over all connected pieces. Existing clusters on the way are merged.
VANTAGE_INLINE void FrontierTracker::gather(const PieceNumber& first) {
  std::uint32_t cluster = static_cast<std::uint32_t>(clusters_.size());
  if (unused_clusters_.empty()) {
    clusters_.emplace_back();
  } else {
    cluster = unused_clusters_.back();
    unused_clusters_.pop_back();
  }
  std::vector<PieceNumber> open;
  const auto take = [&](const PieceNumber& number) {
    at(number).cluster = cluster;
    clusters_[cluster].pieces.push_back(number);
    clusters_[cluster].cells += detail::size_of(at(number).cells);
    open.push_back(number);
  };
  take(first);
  while (!open.empty()) {
    const PieceNumber here = open.back();
    open.pop_back();
    for (const PieceNumber& other : at(here).touching) {
      const std::uint32_t met = at(other).cluster;
      if (met == detail::kNone) {
        take(other);
      } else if (met != cluster) {
        cluster = merge(cluster, met);
      }
    }
  }
}

// Moves the pieces of the smaller cluster to the larger one and returns the larger one.
VANTAGE_INLINE std::uint32_t FrontierTracker::merge(std::uint32_t a, std::uint32_t b) {
  if (clusters_[a].pieces.size() < clusters_[b].pieces.size()) {
    std::swap(a, b);
  }
  for (const PieceNumber& number : clusters_[b].pieces) {
    at(number).cluster = a;
    clusters_[a].pieces.push_back(number);
  }
  clusters_[a].cells += clusters_[b].cells;
  clusters_[b] = {};
  unused_clusters_.push_back(b);
  return a;
}

// The adjacent pieces in other bricks, each once.
VANTAGE_INLINE std::vector<FrontierTracker::PieceNumber> FrontierTracker::neighbours(
    const PieceNumber& number) const {
  const BrickFrontier& brick = bricks_[number.brick];
  std::vector<PieceNumber> found;
  const auto visit = [&](const VoxelIndex& cell) {
    const auto known = numbers_.find(Brick::of_cell(cell));
    const std::size_t offset = Brick::offset_of(cell);
    if (known == numbers_.end() || !detail::has(bricks_[known->second].cells, offset)) {
      return;
    }
    const PieceNumber other{known->second, piece_at(known->second, offset)};
    if (std::find(found.begin(), found.end(), other) == found.end()) {
      found.push_back(other);
    }
  };
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    for_each_offset(brick.pieces[number.piece].cells[word] & detail::kShell[word], word, [&](std::size_t offset) {
      const VoxelIndex cell = Brick::cell_at(brick.address, offset);
      for (const VoxelIndex& step : steps_) {
        if (Brick::of_cell(cell + step) != brick.address) {
          visit(cell + step);
        }
      }
    });
  }
  return found;
}

VANTAGE_INLINE std::uint32_t FrontierTracker::piece_at(std::uint32_t brick, std::size_t offset) const {
  const std::vector<Piece>& pieces = bricks_[brick].pieces;
  const auto found = std::find_if(pieces.begin(), pieces.end(),
                                  [&](const Piece& piece) { return detail::has(piece.cells, offset); });
  return static_cast<std::uint32_t>(found - pieces.begin());
}

VANTAGE_INLINE bool FrontierTracker::contains(const VoxelIndex& cell) const { return cluster_size(cell) > 0; }

VANTAGE_INLINE std::size_t FrontierTracker::cluster_size(const VoxelIndex& cell) const {
  const auto known = numbers_.find(Brick::of_cell(cell));
  const std::size_t offset = Brick::offset_of(cell);
  if (known == numbers_.end() || !detail::has(bricks_[known->second].cells, offset)) {
    return 0;
  }
  return clusters_[bricks_[known->second].pieces[piece_at(known->second, offset)].cluster].cells;
}

VANTAGE_INLINE std::vector<VoxelIndex> FrontierTracker::cells() const {
  std::vector<VoxelIndex> cells;
  cells.reserve(cell_count_);
  for (const BrickFrontier& brick : bricks_) {
    detail::append(brick.cells, brick.address, cells);
  }
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  return cells;
}

VANTAGE_INLINE std::vector<std::vector<VoxelIndex>> FrontierTracker::clusters() const {
  std::vector<std::vector<VoxelIndex>> all;
  for (const Cluster& cluster : clusters_) {
    if (cluster.cells == 0) {
      continue;
    }
    std::vector<VoxelIndex>& cells = all.emplace_back();
    cells.reserve(cluster.cells);
    for (const PieceNumber& number : cluster.pieces) {
      const BrickFrontier& brick = bricks_[number.brick];
      detail::append(brick.pieces[number.piece].cells, brick.address, cells);
    }
    std::sort(cells.begin(), cells.end(), RasterOrder{});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return RasterOrder{}(a.front(), b.front()); });
  return all;
}

}  // namespace vantage
