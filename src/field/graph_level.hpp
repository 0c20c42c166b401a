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

  std::size_t size = 0;
  std::size_t even = 0;          ///< how many nodes are of even parity
  AlignedVector<VoxelIndex> at;  ///< address in units of the cubes of this level
  AlignedVector<Six> six;        ///< of each node
  std::vector<std::uint32_t>
      first_more;  ///< where in `more` the edges of a node beyond six start; one more than nodes
  std::vector<Edge> more;
  AlignedVector<float> leak;               ///< to the sinks
  AlignedVector<float> diagonal;           ///< the sum of all conductances
  AlignedVector<float> inverse;            ///< of that
  AlignedVector<std::uint32_t> node;       ///< of the next coarser level
  AlignedVector<std::uint32_t> children;   ///< the nodes in the order of those of the next coarser level
  std::vector<std::uint32_t> first_child;  ///< of each of those, in `children`; one more than there are
  AlignedVector<float> x;                  ///< the correction, and a 0
  AlignedVector<float> right;              ///< the right hand side, and one that is not used

  /// Room for so many nodes, the first `even_nodes` of them even, whose addresses and edges are still to be written.
  GraphLevel(std::size_t nodes, std::size_t even_nodes);

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
  void restrict_to(ThreadTeam& team, AlignedVector<float>& sums) const;
  void prolong(ThreadTeam& team, const AlignedVector<float>& correction);
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  [[nodiscard]] float inflow(std::size_t of) const;
};

/// How much larger the step of a coarse level is than what plain aggregation gives, inverted: its correction is too
/// small because it has steps where the solution has slopes.
inline constexpr float kOverCorrection = 0.5F;

[[nodiscard]] inline bool is_even(const VoxelIndex& at) { return ((at.x ^ at.y ^ at.z) & 1) == 0; }

/// Writes the edges of a level's nodes, one node after the other. Several writers may share the nodes among them.
class EdgeWriter {
 public:
  explicit EdgeWriter(GraphLevel& level) : level_(level) {}

  /// A conductance from the node that comes next; several to the same neighbour add up.
  void join(std::uint32_t to, float conductance);
  /// A conductance from it to the sinks.
  void leak(float conductance) { leak_ += conductance; }
  /// There are no more of them: these are those of node `of`.
  void write(std::uint32_t of);

  /// Gathers what does not fit into the places of the nodes, when all are written.
  static void finish(GraphLevel& level, const std::vector<EdgeWriter>& writers);

 private:
  struct Rest {
    std::uint32_t of;
    GraphLevel::Edge edge;
  };

  GraphLevel& level_;
  float leak_ = 0.0F;
  std::vector<GraphLevel::Edge> edges_;
  std::vector<Rest> rest_;
};

/// The next level: pieces of 2 x 2 x 2 cubes that hang together. Sets `finer.node` and its children.
[[nodiscard]] GraphLevel coarsen(ThreadTeam& team, GraphLevel& finer);

}  // namespace vantage::detail
