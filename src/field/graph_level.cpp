// SPDX-License-Identifier: MIT
#include "field/graph_level.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vantage/geometry/raster_order.hpp>

namespace vantage::detail {
namespace {

// Relaxation goes a little too far (SOR), which smooths better than Gauss-Seidel in three dimensions.
constexpr float kNodeWeight = 1.15F;
// Fewer nodes per thread are done before a second thread has begun.
constexpr std::size_t kGrain = 2000;

VoxelIndex halved(const VoxelIndex& at) { return {at.x >> 1, at.y >> 1, at.z >> 1}; }
bool is_even(const VoxelIndex& at) { return ((at.x ^ at.y ^ at.z) & 1) == 0; }

// The nodes in the order of their parents: even parents first, each in raster order.
std::vector<std::uint32_t> by_parent(const std::vector<VoxelIndex>& at) {
  std::vector<std::uint32_t> order(at.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const VoxelIndex parent_a = halved(at[a]);
    const VoxelIndex parent_b = halved(at[b]);
    if (parent_a == parent_b) {
      return a < b;
    }
    return is_even(parent_a) != is_even(parent_b) ? is_even(parent_a) : RasterOrder{}(parent_a, parent_b);
  });
  return order;
}

}  // namespace

GraphLevel::GraphLevel(std::vector<VoxelIndex> addresses, std::vector<float> leaks, const std::vector<Join>& joins)
    : size(addresses.size()), at(std::move(addresses)), leak(std::move(leaks)) {
  even = static_cast<std::size_t>(std::count_if(at.begin(), at.end(), is_even));
  // Sort by counting, then merge what several joins say of one pair.
  std::vector<std::uint32_t> first(size + 2, 0);
  for (const Join& join : joins) {
    ++first[join.a + 2];
    ++first[join.b + 2];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Edge> edges(2 * joins.size());
  for (const Join& join : joins) {
    edges[first[join.a + 1]++] = {join.b, join.conductance};
    edges[first[join.b + 1]++] = {join.a, join.conductance};
  }
  Six none;
  none.fill({static_cast<std::uint32_t>(size), 0.0F});
  six.assign(size, none);
  first_more.assign(size + 1, 0);
  diagonal.resize(size);
  inverse.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    std::size_t count = 0;
    float sum = leak[i];
    for (std::uint32_t e = first[i]; e < first[i + 1]; ++e) {
      sum += edges[e].conductance;
      std::size_t same = 0;
      const auto place = [&](std::size_t n) -> Edge& { return n < 6 ? six[i][n] : more[first_more[i] + n - 6]; };
      while (same < count && place(same).to != edges[e].to) {
        ++same;
      }
      if (same < count) {
        place(same).conductance += edges[e].conductance;
        continue;
      }
      if (count >= 6) {
        more.emplace_back();
      }
      place(count++) = edges[e];
    }
    first_more[i + 1] = static_cast<std::uint32_t>(more.size());
    diagonal[i] = sum;
    inverse[i] = sum > 0.0F ? 1.0F / sum : 0.0F;
  }
  x.assign(size + 1, 0.0F);
  right.assign(size + 1, 0.0F);
}

// Sum of conductance * neighbour.
inline float GraphLevel::inflow(std::size_t of) const {
  const Six& e = six[of];
  const auto term = [&](std::size_t n) { return e[n].conductance * x[e[n].to]; };
  float sum = (term(0) + term(1)) + (term(2) + term(3)) + (term(4) + term(5));
  for (std::uint32_t i = first_more[of]; i < first_more[of + 1]; ++i) {
    sum += more[i].conductance * x[more[i].to];
  }
  return sum;
}

void GraphLevel::smooth(ThreadTeam& team, bool even_first) {
  const auto relax = [&](std::size_t first, std::size_t last) {
    team.split(last - first, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i) {
        x[i] += kNodeWeight * ((right[i] + inflow(i)) * inverse[i] - x[i]);
      }
    });
  };
  if (even_first) {
    relax(0, even);
    relax(even, size);
  } else {
    relax(even, size);
    relax(0, even);
  }
}

void GraphLevel::smooth_from_zero(ThreadTeam& team) {
  team.split(even, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      x[i] = kNodeWeight * (right[i] * inverse[i]);
    }
  });
  team.split(size - even, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = even + begin; i < even + end; ++i) {
      x[i] = kNodeWeight * ((right[i] + inflow(i)) * inverse[i]);
    }
  });
}

void GraphLevel::restrict_to(ThreadTeam& team, std::vector<float>& sums) const {
  team.split(first_child.size() - 1, kGrain / 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t to = begin; to < end; ++to) {
      float sum = 0.0F;
      for (std::uint32_t c = first_child[to]; c < first_child[to + 1]; ++c) {
        const std::uint32_t i = children[c];
        sum += right[i] - diagonal[i] * x[i] + inflow(i);
      }
      sums[to] = sum;
    }
  });
}

void GraphLevel::prolong(ThreadTeam& team, const std::vector<float>& correction) {
  team.split(size, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      x[i] += correction[node[i]];
    }
  });
}

std::size_t GraphLevel::memory_bytes() const {
  return bytes_of(at) + bytes_of(six) + bytes_of(first_more) + bytes_of(more) + bytes_of(diagonal) + bytes_of(leak) +
         bytes_of(inverse) + bytes_of(node) + bytes_of(children) + bytes_of(first_child) + bytes_of(x) +
         bytes_of(right);
}

GraphLevel coarsen(GraphLevel& finer) {
  finer.node.assign(finer.size, kNoNode);
  std::vector<VoxelIndex> at;
  std::vector<std::uint32_t> queue;
  for (const std::uint32_t seed : by_parent(finer.at)) {
    if (finer.node[seed] != kNoNode) {
      continue;
    }
    const auto number = static_cast<std::uint32_t>(at.size());
    at.push_back(halved(finer.at[seed]));
    finer.node[seed] = number;
    queue.assign(1, seed);
    for (std::size_t next = 0; next < queue.size(); ++next) {
      finer.for_each_edge(queue[next], [&](const GraphLevel::Edge& edge) {
        if (finer.node[edge.to] == kNoNode && halved(finer.at[edge.to]) == at.back()) {
          finer.node[edge.to] = number;
          queue.push_back(edge.to);
        }
      });
    }
  }
  finer.first_child.assign(at.size() + 1, 0);
  for (const std::uint32_t parent : finer.node) {
    ++finer.first_child[parent + 1];
  }
  std::partial_sum(finer.first_child.begin(), finer.first_child.end(), finer.first_child.begin());
  finer.children.resize(finer.size);
  std::vector<std::uint32_t> next_place(finer.first_child.begin(), finer.first_child.end() - 1);
  for (std::uint32_t i = 0; i < finer.size; ++i) {
    finer.children[next_place[finer.node[i]]++] = i;
  }
  std::vector<float> leaks(at.size(), 0.0F);
  std::vector<GraphLevel::Join> joins;
  for (std::uint32_t i = 0; i < finer.size; ++i) {
    leaks[finer.node[i]] += kOverCorrection * finer.leak[i];
    finer.for_each_edge(i, [&](const GraphLevel::Edge& edge) {
      if (i < edge.to && finer.node[i] != finer.node[edge.to]) {
        joins.push_back({finer.node[i], finer.node[edge.to], kOverCorrection * edge.conductance});
      }
    });
  }
  return {std::move(at), std::move(leaks), joins};
}

}  // namespace vantage::detail
