// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <vantage/field/impl/graph_level.hpp>

namespace vantage::detail {

// Below this, sorting is done before a second thread has started.
inline constexpr std::size_t kFewestNodes = 4000;

inline VoxelIndex cube_of(const VoxelIndex& at) { return {at.x >> 1, at.y >> 1, at.z >> 1}; }

// A node with a sort key: the cube of 2 x 2 x 2 that contains it. Even cubes come first, in raster order within a
// parity.
struct Placed {
  std::uint64_t parity_and_z;
  std::uint64_t y_and_x;
  std::uint32_t node;

  Placed() = default;
  Placed(const VoxelIndex& at, std::uint32_t number) : node(number) {
    const VoxelIndex cube = cube_of(at);
    const auto above = [](std::int32_t coordinate) {
      return std::uint64_t{static_cast<std::uint32_t>(coordinate) ^ 0x80000000U};
    };
    parity_and_z = (is_even(cube) ? 0U : std::uint64_t{1} << 32U) | above(cube.z);
    y_and_x = above(cube.y) << 32U | above(cube.x);
  }
  [[nodiscard]] bool same_cube(const Placed& other) const {
    return parity_and_z == other.parity_and_z && y_and_x == other.y_and_x;
  }
  friend bool operator<(const Placed& a, const Placed& b) {
    return a.parity_and_z != b.parity_and_z ? a.parity_and_z < b.parity_and_z
           : a.y_and_x != b.y_and_x         ? a.y_and_x < b.y_and_x
                                            : a.node < b.node;
  }
};

inline AlignedVector<Placed> by_cube(ThreadTeam& team, const GraphLevel& level) {
  AlignedVector<Placed> order(level.size);
  const std::size_t parts = level.size < kFewestNodes ? 1 : team.size();
  const auto start = [&](std::size_t part) { return order.data() + level.size * part / parts; };
  const auto sort_part = [&](std::size_t part) {
    for (std::size_t i = level.size * part / parts; i < level.size * (part + 1) / parts; ++i) {
      order[i] = Placed(level.at[i], static_cast<std::uint32_t>(i));
    }
    std::sort(start(part), start(part + 1));
  };
  if (parts == 1) {
    sort_part(0);
  } else {
    team.run(sort_part);
  }
  for (std::size_t part = 1; part < parts; ++part) {
    std::inplace_merge(order.data(), start(part), start(part + 1));
  }
  return order;
}

// The connected pieces of some cubes, numbered from 0.
struct Pieces {
  std::vector<VoxelIndex> at;
  std::vector<std::uint32_t> children;  // the nodes of all pieces, piece by piece
  std::vector<std::uint32_t> ends;      // end of each piece in `children`
  std::size_t even = 0;

  // Adds the connected piece of `seed` inside `cube`.
  void add(GraphLevel& finer, const VoxelIndex& cube, std::uint32_t seed) {
    const auto number = static_cast<std::uint32_t>(at.size());
    std::size_t next = children.size();
    at.push_back(cube);
    even += is_even(cube) ? 1U : 0U;
    finer.node[seed] = number;
    children.push_back(seed);
    for (; next < children.size(); ++next) {
      finer.for_each_edge(children[next], [&](const GraphLevel::Edge& edge) {
        if (cube_of(finer.at[edge.to]) == cube && finer.node[edge.to] == kNoNode) {
          finer.node[edge.to] = number;
          children.push_back(edge.to);
        }
      });
    }
    ends.push_back(static_cast<std::uint32_t>(children.size()));
  }
};

// Finds the pieces of all cubes, in one part per thread. No cube is split between parts.
inline std::vector<Pieces> find_pieces(ThreadTeam& team, GraphLevel& finer) {
  const AlignedVector<Placed> order = by_cube(team, finer);
  const auto start = [&](std::size_t part) {
    std::size_t i = order.size() * part / team.size();
    while (i > 0 && i < order.size() && order[i].same_cube(order[i - 1])) {
      ++i;
    }
    return i;
  };
  std::vector<Pieces> parts(team.size());
  team.run([&](std::size_t part) {
    const std::size_t end = start(part + 1);
    for (std::size_t i = start(part); i < end; ++i) {
      finer.node[order[i].node] = kNoNode;
    }
    for (std::size_t i = start(part); i < end; ++i) {
      if (const std::uint32_t seed = order[i].node; finer.node[seed] == kNoNode) {
        parts[part].add(finer, cube_of(finer.at[seed]), seed);
      }
    }
  });
  return parts;
}

// First node and first child of a part.
struct PartBegin {
  std::size_t node = 0;
  std::size_t child = 0;
};

// Writes the nodes of a part, and their links in the finer level.
inline void number_part(GraphLevel& finer, GraphLevel& coarser, const Pieces& pieces, const PartBegin& begin) {
  std::size_t c = 0;
  for (std::size_t n = 0; n < pieces.at.size(); ++n) {
    const std::size_t number = begin.node + n;
    coarser.at[number] = pieces.at[n];
    for (; c < pieces.ends[n]; ++c) {
      finer.node[pieces.children[c]] = static_cast<std::uint32_t>(number);
      finer.children[begin.child + c] = pieces.children[c];
    }
    finer.first_child[number + 1] = static_cast<std::uint32_t>(begin.child + c);
  }
}

inline void write_edges(const GraphLevel& finer, EdgeWriter& writer, std::size_t first, std::size_t last) {
  for (std::size_t to = first; to < last; ++to) {
    const auto own = static_cast<std::uint32_t>(to);
    for (std::uint32_t c = finer.first_child[to]; c < finer.first_child[to + 1]; ++c) {
      const std::uint32_t child = finer.children[c];
      writer.leak(kOverCorrection * finer.leak[child]);
      finer.for_each_edge(child, [&](const GraphLevel::Edge& edge) {
        if (finer.node[edge.to] != own) {
          writer.join(finer.node[edge.to], kOverCorrection * edge.conductance);
        }
      });
    }
    writer.write(own);
  }
}

VANTAGE_INLINE GraphLevel coarsen(ThreadTeam& team, GraphLevel& finer) {
  finer.node.resize(finer.size);
  finer.children.resize(finer.size);
  const std::vector<Pieces> parts = find_pieces(team, finer);
  std::vector<PartBegin> begins;
  PartBegin end;
  std::size_t even = 0;
  for (const Pieces& pieces : parts) {
    begins.push_back(end);
    end.node += pieces.at.size();
    end.child += pieces.children.size();
    even += pieces.even;
  }
  finer.first_child.assign(end.node + 1, 0);
  GraphLevel coarser(end.node, even);
  team.run([&](std::size_t part) { number_part(finer, coarser, parts[part], begins[part]); });
  std::vector<EdgeWriter> writers(team.size(), EdgeWriter(coarser));
  team.run([&](std::size_t part) {
    write_edges(finer, writers[part], begins[part].node, begins[part].node + parts[part].at.size());
  });
  EdgeWriter::finish(coarser, writers);
  return coarser;
}

}  // namespace vantage::detail
