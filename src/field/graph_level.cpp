// SPDX-License-Identifier: MIT
#include "field/graph_level.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vantage/geometry/raster_order.hpp>

namespace vantage::detail {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;
// Relaxation goes a little too far (SOR), which smooths better than Gauss-Seidel in three dimensions.
constexpr float kWeight = 1.15F;

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
    : size(addresses.size()), at(std::move(addresses)), first(size + 2, 0), leak(std::move(leaks)) {
  even = static_cast<std::size_t>(std::count_if(at.begin(), at.end(), is_even));
  // Sort by counting, then merge what several joins say of one pair.
  for (const Join& join : joins) {
    ++first[join.a + 2];
    ++first[join.b + 2];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  edges.resize(2 * joins.size());
  for (const Join& join : joins) {
    edges[first[join.a + 1]++] = {join.b, join.conductance};
    edges[first[join.b + 1]++] = {join.a, join.conductance};
  }
  first.pop_back();
  inverse.resize(size);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t from = kept;
    float diagonal = leak[i];
    for (std::uint32_t e = std::exchange(first[i], from); e < first[i + 1]; ++e) {
      const Edge edge = edges[e];
      diagonal += edge.conductance;
      std::uint32_t same = from;
      while (same < kept && edges[same].to != edge.to) {
        ++same;
      }
      if (same < kept) {
        edges[same].conductance += edge.conductance;
      } else {
        edges[kept++] = edge;
      }
    }
    inverse[i] = diagonal > 0.0F ? 1.0F / diagonal : 0.0F;
  }
  first[size] = kept;
  edges.resize(kept);
  edges.shrink_to_fit();
  x.assign(size + 1, 0.0F);
  right.assign(size + 1, 0.0F);
}

void GraphLevel::smooth(bool even_first) {
  const auto relax = [this](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float sum = right[i];
      for (std::uint32_t e = first[i]; e < first[i + 1]; ++e) {
        sum += edges[e].conductance * x[edges[e].to];
      }
      x[i] += kWeight * (sum * inverse[i] - x[i]);
    }
  };
  if (even_first) {
    relax(0, even);
    relax(even, size);
  } else {
    relax(even, size);
    relax(0, even);
  }
}

void GraphLevel::restrict_to(std::vector<float>& sums) const {
  std::fill(sums.begin(), sums.end(), 0.0F);
  for (std::size_t i = 0; i < size; ++i) {
    float sum = right[i] - (inverse[i] > 0.0F ? x[i] / inverse[i] : 0.0F);
    for (std::uint32_t e = first[i]; e < first[i + 1]; ++e) {
      sum += edges[e].conductance * x[edges[e].to];
    }
    sums[node[i]] += sum;
  }
}

void GraphLevel::prolong(const std::vector<float>& correction) {
  for (std::size_t i = 0; i < size; ++i) {
    x[i] += correction[node[i]];
  }
}

std::size_t GraphLevel::memory_bytes() const {
  return bytes_of(at) + bytes_of(first) + bytes_of(edges) + bytes_of(leak) + bytes_of(inverse) + bytes_of(node) +
         bytes_of(x) + bytes_of(right);
}

GraphLevel coarsen(GraphLevel& finer) {
  finer.node.assign(finer.size, kNone);
  std::vector<VoxelIndex> at;
  std::vector<std::uint32_t> queue;
  for (const std::uint32_t seed : by_parent(finer.at)) {
    if (finer.node[seed] != kNone) {
      continue;
    }
    const auto number = static_cast<std::uint32_t>(at.size());
    at.push_back(halved(finer.at[seed]));
    finer.node[seed] = number;
    queue.assign(1, seed);
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (std::uint32_t e = finer.first[queue[next]]; e < finer.first[queue[next] + 1]; ++e) {
        const std::uint32_t to = finer.edges[e].to;
        if (finer.node[to] == kNone && halved(finer.at[to]) == at.back()) {
          finer.node[to] = number;
          queue.push_back(to);
        }
      }
    }
  }
  std::vector<float> leaks(at.size(), 0.0F);
  std::vector<GraphLevel::Join> joins;
  for (std::uint32_t i = 0; i < finer.size; ++i) {
    leaks[finer.node[i]] += kOverCorrection * finer.leak[i];
    for (std::uint32_t e = finer.first[i]; e < finer.first[i + 1]; ++e) {
      if (const GraphLevel::Edge& edge = finer.edges[e]; i < edge.to && finer.node[i] != finer.node[edge.to]) {
        joins.push_back({finer.node[i], finer.node[edge.to], kOverCorrection * edge.conductance});
      }
    }
  }
  return {std::move(at), std::move(leaks), joins};
}

}  // namespace vantage::detail
