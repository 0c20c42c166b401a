// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// A bounding box tree of the cells that a sensor may look from. A query can skip whole boxes that no line of
/// sight reaches.
class PoseTree {
 public:
  explicit PoseTree(std::vector<VoxelIndex> poses) : poses_(std::move(poses)) {
    if (!poses_.empty()) {
      split(0, poses_.size());
    }
  }

  /// Calls `ask(pose)` for the poses, nearer boxes first, until one returns true; returns whether one did. Skips
  /// boxes that are further from `cell` than `furthest_cells` (centre to centre, in cells) and boxes that cells
  /// with `is_solid` occlude completely.
  template <class IsSolid, class Ask>
  bool any(const VoxelIndex& cell, double furthest_cells, const IsSolid& is_solid, const Ask& ask) const {
    return !nodes_.empty() && any_in(0, {cell, furthest_cells}, is_solid, ask);
  }

 private:
  static constexpr std::size_t kLeaf = 4;  // most poses of a leaf

  struct Node {
    VoxelBox box;
    std::size_t first = 0;
    std::size_t end = 0;
    std::size_t near = 0;  // node of the first half; 0: a leaf
    std::size_t far = 0;
  };
  struct Query {
    VoxelIndex cell;
    double furthest_cells;
  };
  struct Range {
    double lo;
    double hi;
  };

  static std::array<std::int32_t, 3> axes_of(const VoxelIndex& v) { return {v.x, v.y, v.z}; }

  std::size_t split(std::size_t first, std::size_t end) {
    Node node{.box = {poses_[first], poses_[first]}, .first = first, .end = end};
    for (std::size_t i = first; i < end; ++i) {
      const VoxelIndex& p = poses_[i];
      node.box.lo = {std::min(node.box.lo.x, p.x), std::min(node.box.lo.y, p.y), std::min(node.box.lo.z, p.z)};
      node.box.hi = {std::max(node.box.hi.x, p.x), std::max(node.box.hi.y, p.y), std::max(node.box.hi.z, p.z)};
    }
    const std::array<std::int32_t, 3> extent = axes_of(node.box.hi - node.box.lo);
    node.box.hi = node.box.hi + VoxelIndex{1, 1, 1};
    const std::size_t at = nodes_.size();
    nodes_.push_back(node);
    if (end - first > kLeaf) {
      const auto axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
      const std::size_t middle = first + (end - first) / 2;
      const auto position = [&](std::size_t i) { return poses_.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(position(first), position(middle), position(end), [&](const auto& a, const auto& b) {
        const std::int32_t along_a = axes_of(a)[axis];
        const std::int32_t along_b = axes_of(b)[axis];
        return along_a != along_b ? along_a < along_b : a < b;
      });
      nodes_[at].near = split(first, middle);
      nodes_[at].far = split(middle, end);
    }
    return at;
  }

  // Squared distance in cells between the centre of the cell and the nearest cell centre of the box.
  static double distance_squared(const Node& node, const VoxelIndex& cell) {
    const auto gap = [](std::int32_t lo, std::int32_t hi, std::int32_t at) {
      return static_cast<double>(std::max({lo - at, at - (hi - 1), 0}));
    };
    const VoxelBox& box = node.box;
    const double x = gap(box.lo.x, box.hi.x, cell.x);
    const double y = gap(box.lo.y, box.hi.y, cell.y);
    const double z = gap(box.lo.z, box.hi.z, cell.z);
    return x * x + y * y + z * z;
  }

  template <class IsSolid, class Ask>
  bool any_in(std::size_t at, const Query& query, const IsSolid& is_solid, const Ask& ask) const {
    const Node& node = nodes_[at];
    const double furthest = query.furthest_cells + 1e-6;
    if (distance_squared(node, query.cell) > furthest * furthest || is_hidden(node.box, query.cell, is_solid)) {
      return false;
    }
    if (node.near == 0) {
      return std::any_of(poses_.begin() + static_cast<std::ptrdiff_t>(node.first),
                         poses_.begin() + static_cast<std::ptrdiff_t>(node.end), ask);
    }
    const bool in_order =
        distance_squared(nodes_[node.near], query.cell) <= distance_squared(nodes_[node.far], query.cell);
    return any_in(in_order ? node.near : node.far, query, is_solid, ask) ||
           any_in(in_order ? node.far : node.near, query, is_solid, ask);
  }

  // Whether one slice of cells between them blocks all lines from the centre of the cell to those of the box. A
  // slice that does not usually shows a free cell among its first cells.
  template <class IsSolid>
  static bool is_hidden(const VoxelBox& box, const VoxelIndex& cell, const IsSolid& is_solid) {
    const std::array<std::int32_t, 3> lo = axes_of(box.lo - cell);
    const std::array<std::int32_t, 3> hi = axes_of(box.hi - VoxelIndex{1, 1, 1} - cell);
    std::size_t main = 3;
    std::int32_t nearest = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (const std::int32_t gap = std::max(lo[axis], -hi[axis]); gap > nearest) {
        main = axis;
        nearest = gap;
      }
    }
    if (main == 3) {
      return false;
    }
    const bool ahead = lo[main] > 0;
    const Range along{static_cast<double>(nearest), static_cast<double>(ahead ? hi[main] : -lo[main])};
    const std::size_t u = (main + 1) % 3;
    const std::size_t v = (main + 2) % 3;
    const Range slope_u = slopes(lo[u], hi[u], along);
    const Range slope_v = slopes(lo[v], hi[v], along);
    for (std::int32_t slice = 1; slice < nearest; ++slice) {
      const auto [first_u, last_u] = crossed(slope_u, slice);
      const auto [first_v, last_v] = crossed(slope_v, slice);
      bool all_solid = true;
      for (std::int32_t b = first_v; b <= last_v && all_solid; ++b) {
        for (std::int32_t a = first_u; a <= last_u && all_solid; ++a) {
          std::array<std::int32_t, 3> step{};
          step[main] = ahead ? slice : -slice;
          step[u] = a;
          step[v] = b;
          all_solid = is_solid(cell + VoxelIndex{step[0], step[1], step[2]});
        }
      }
      if (all_solid) {
        return true;
      }
    }
    return false;
  }

  // Range of the slopes of the lines to all points (across, along) in these ranges.
  static Range slopes(std::int32_t lo, std::int32_t hi, const Range& along) {
    return {lo / (lo < 0 ? along.lo : along.hi), hi / (hi < 0 ? along.hi : along.lo)};
  }
  // First and last cell of a slice that these lines may touch, borders included.
  static std::pair<std::int32_t, std::int32_t> crossed(const Range& slope, std::int32_t slice) {
    constexpr double kRounding = 1e-6;
    const double from = slope.lo * (slice + (slope.lo < 0.0 ? 0.5 : -0.5));
    const double to = slope.hi * (slice + (slope.hi < 0.0 ? -0.5 : 0.5));
    return {static_cast<std::int32_t>(std::floor(from + 0.5 - kRounding)),
            static_cast<std::int32_t>(std::floor(to + 0.5 + kRounding))};
  }

  std::vector<VoxelIndex> poses_;
  std::vector<Node> nodes_;
};

}  // namespace vantage::detail
