// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vector>

#include <vantage/field/impl/aligned_vector.hpp>
#include <vantage/field/impl/thread_team.hpp>

namespace vantage::detail {

inline constexpr std::uint32_t kNoNode = 0xFFFFFFFFU;  ///< stands for no node

/// An unstructured coarse level: nodes connected by conductances. A node is a connected piece of a cube of cells and
/// has the address of that cube. Nodes with even x + y + z come first. Edges connect only nodes of different parity.
struct GraphLevel {
  struct Edge {
    std::uint32_t to;
    float conductance;
  };
  /// The first six edges of a node; most nodes have no more. Unused entries point to the 0 at the end of `x`.
  using Six = std::array<Edge, 6>;

  std::size_t size = 0;
  std::size_t even = 0;                   ///< number of nodes with even parity
  AlignedVector<VoxelIndex> at;           ///< address of each node, in units of the cubes of this level
  AlignedVector<Six> six;                 ///< edges of each node
  std::vector<std::uint32_t> first_more;  ///< start of each node's further edges in `more`; one entry more than nodes
  std::vector<Edge> more;
  AlignedVector<float> leak;              ///< conductance to the sinks
  AlignedVector<float> diagonal;          ///< sum of all conductances
  AlignedVector<float> inverse;           ///< 1 / diagonal
  AlignedVector<std::uint32_t> node;      ///< node of the next coarser level
  AlignedVector<std::uint32_t> children;  ///< the nodes, ordered by their node of the next coarser level
  /// start of each coarser node's range in `children`; one entry more than coarser nodes
  std::vector<std::uint32_t> first_child;
  AlignedVector<float> x;      ///< the correction, followed by a 0
  AlignedVector<float> right;  ///< the right hand side, followed by an unused entry

  /// Allocates the nodes, the first `even_nodes` of them even. Addresses and edges must be written afterwards.
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
  /// One relaxation, with the even nodes first or last.
  void smooth(ThreadTeam& team, bool even_first);
  /// One relaxation from x = 0, even nodes first. It overwrites `x` without reading it.
  void smooth_from_zero(ThreadTeam& team);
  void restrict_to(ThreadTeam& team, AlignedVector<float>& sums) const;
  void prolong(ThreadTeam& team, const AlignedVector<float>& correction);
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  [[nodiscard]] float inflow(std::size_t of) const;
};

/// Scale of the conductances of a coarse level relative to plain aggregation. A value of 0.5 doubles the correction.
/// Plain corrections are too small, because they are piecewise constant where the solution has slopes.
inline constexpr float kOverCorrection = 0.5F;

[[nodiscard]] inline bool is_even(const VoxelIndex& at) { return ((at.x ^ at.y ^ at.z) & 1) == 0; }

/// Writes the edges of the nodes of a level, node by node. Several writers may divide the nodes among them.
class EdgeWriter {
 public:
  explicit EdgeWriter(GraphLevel& level) : level_(level) {}

  /// Adds a conductance from the current node to `to`. Conductances to the same node add up.
  void join(std::uint32_t to, float conductance);
  /// Adds a conductance from the current node to the sinks.
  void leak(float conductance) { leak_ += conductance; }
  /// Finishes the current node and stores it as node `of`.
  void write(std::uint32_t of);

  /// Collects the edges that exceed six per node. Call it once after all nodes are written.
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

/// Builds the next coarser level from the connected pieces of 2 x 2 x 2 cubes. Sets `finer.node`, `finer.children`
/// and `finer.first_child`.
[[nodiscard]] GraphLevel coarsen(ThreadTeam& team, GraphLevel& finer);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/coarsen.ipp>
#include <vantage/field/impl/graph_level.ipp>
#endif
