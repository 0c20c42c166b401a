// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vector>

#include "field/aligned_vector.hpp"

namespace vantage::detail {

/// A coarse level without structure: nodes joined by conductances, each at the address of a cube of cells of which it is
/// one connected piece. Nodes of even x + y + z come first, and only nodes of different parity are ever joined.
struct GraphLevel {
  struct Edge {
    std::uint32_t to;
    float conductance;
  };
  /// A conductance between two nodes, given once.
  struct Join {
    std::uint32_t a;
    std::uint32_t b;
    float conductance;
  };

  std::size_t size = 0;
  std::size_t even = 0;                  ///< how many nodes are of even parity
  std::vector<VoxelIndex> at;            ///< address in units of the cubes of this level
  std::vector<std::uint32_t> first;      ///< of each node's edges; one more than nodes
  std::vector<Edge> edges;
  std::vector<float> leak;               ///< to the sinks
  std::vector<float> inverse;            ///< of the sum of all conductances
  std::vector<std::uint32_t> node;       ///< of the next coarser level
  std::vector<float> x;                  ///< the correction, and a 0
  std::vector<float> right;              ///< the right hand side, and one that is not used

  /// Nodes by their addresses (even ones first) and leaks; several joins of one pair add up.
  GraphLevel(std::vector<VoxelIndex> addresses, std::vector<float> leaks, const std::vector<Join>& joins);

  void smooth(bool even_first);
  void restrict_to(std::vector<float>& sums) const;
  void prolong(const std::vector<float>& correction);
  [[nodiscard]] std::size_t memory_bytes() const;
};

/// How much larger the step of a coarse level is than what plain aggregation gives, inverted: its correction is too small
/// because it has steps where the solution has slopes.
inline constexpr float kOverCorrection = 0.55F;

/// The next level: pieces of 2 x 2 x 2 cubes that hang together. Sets `finer.node`.
[[nodiscard]] GraphLevel coarsen(GraphLevel& finer);

}  // namespace vantage::detail
