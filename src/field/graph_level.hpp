// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vector>

#include "field/aligned_vector.hpp"
#include "field/thread_team.hpp"

namespace vantage::detail {

inline constexpr std::uint32_t kNoNode = 0xFFFFFFFFU;  ///< the number of no node

/// A coarse level without structure: nodes joined by conductances, each at the address of a cube of cells of which it
/// is one connected piece. Nodes of even x + y + z come first, and only nodes of different parity are ever joined.
struct GraphLevel {
  struct Edge {
    std::uint32_t to;
    float conductance;
  };
  /// The first six neighbours of a node, as most have no more; the rest of the places leads to the 0 that ends `x`.
  using Six = std::array<Edge, 6>;
  /// A conductance between two nodes, given once.
  struct Join {
    std::uint32_t a;
    std::uint32_t b;
    float conductance;
  };

  std::size_t size = 0;
  std::size_t even = 0;        ///< how many nodes are of even parity
  std::vector<VoxelIndex> at;  ///< address in units of the cubes of this level
  std::vector<Six> six;        ///< of each node
  std::vector<std::uint32_t>
      first_more;  ///< where in `more` the edges of a node beyond six start; one more than nodes
  std::vector<Edge> more;
  std::vector<float> leak;                 ///< to the sinks
  std::vector<float> diagonal;             ///< the sum of all conductances
  std::vector<float> inverse;              ///< of that
  std::vector<std::uint32_t> node;         ///< of the next coarser level
  std::vector<std::uint32_t> children;     ///< the nodes in the order of those of the next coarser level
  std::vector<std::uint32_t> first_child;  ///< of each of those, in `children`; one more than there are
  std::vector<float> x;                    ///< the correction, and a 0
  std::vector<float> right;                ///< the right hand side, and one that is not used

  /// Nodes by their addresses (even ones first) and leaks; several joins of one pair add up.
  GraphLevel(std::vector<VoxelIndex> addresses, std::vector<float> leaks, const std::vector<Join>& joins);

  /// Calls `visit(Edge)` for every edge of a node.
  template <class Visit>
  void for_each_edge(std::size_t of, Visit&& visit) const {
    for (const Edge& edge : six[of]) {
      if (edge.to != size) {
        visit(edge);
      }
    }
    for (std::uint32_t e = first_more[of]; e < first_more[of + 1]; ++e) {
      visit(more[e]);
    }
  }
  /// One relaxation, the nodes of even parity before the others or after them.
  void smooth(ThreadTeam& team, bool even_first);
  /// The same, even ones first, from 0, whatever `x` holds.
  void smooth_from_zero(ThreadTeam& team);
  void restrict_to(ThreadTeam& team, std::vector<float>& sums) const;
  void prolong(ThreadTeam& team, const std::vector<float>& correction);
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  [[nodiscard]] float inflow(std::size_t of) const;
};

/// How much larger the step of a coarse level is than what plain aggregation gives, inverted: its correction is too
/// small because it has steps where the solution has slopes.
inline constexpr float kOverCorrection = 0.5F;

/// The next level: pieces of 2 x 2 x 2 cubes that hang together. Sets `finer.node` and its children.
[[nodiscard]] GraphLevel coarsen(GraphLevel& finer);

}  // namespace vantage::detail
