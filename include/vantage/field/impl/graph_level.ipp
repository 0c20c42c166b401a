// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/graph_level.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace vantage::detail {

// Over-relaxation (SOR) smooths better than Gauss-Seidel in three dimensions.
inline constexpr float kNodeWeight = 1.15F;
// With fewer nodes per thread, the work is done before a second thread has started.
inline constexpr std::size_t kGrain = 400;

VANTAGE_INLINE GraphLevel::GraphLevel(std::size_t nodes, std::size_t even_nodes) : size(nodes), even(even_nodes) {
  at.resize(size);
  six.resize(size);
  leak.resize(size);
  diagonal.resize(size);
  inverse.resize(size);
  x.resize(size + 1);
  right.resize(size + 1);
  x[size] = 0.0F;
}

VANTAGE_INLINE void EdgeWriter::join(std::uint32_t to, float conductance) {
  for (GraphLevel::Edge& edge : edges_) {
    if (edge.to == to) {
      edge.conductance += conductance;
      return;
    }
  }
  edges_.push_back({to, conductance});
}

VANTAGE_INLINE void EdgeWriter::write(std::uint32_t of) {
  GraphLevel::Six& six = level_.six[of];
  six.fill({static_cast<std::uint32_t>(level_.size), 0.0F});
  float sum = leak_;
  for (std::size_t n = 0; n < edges_.size(); ++n) {
    sum += edges_[n].conductance;
    if (n < six.size()) {
      six[n] = edges_[n];
    } else {
      rest_.push_back({of, edges_[n]});
    }
  }
  level_.leak[of] = leak_;
  level_.diagonal[of] = sum;
  level_.inverse[of] = sum > 0.0F ? 1.0F / sum : 0.0F;
  level_.x[of] = 0.0F;
  level_.right[of] = 0.0F;
  edges_.clear();
  leak_ = 0.0F;
}

VANTAGE_INLINE void EdgeWriter::finish(GraphLevel& level, const std::vector<EdgeWriter>& writers) {
  std::vector<Rest> all;
  for (const EdgeWriter& writer : writers) {
    all.insert(all.end(), writer.rest_.begin(), writer.rest_.end());
  }
  std::stable_sort(all.begin(), all.end(), [](const Rest& a, const Rest& b) { return a.of < b.of; });
  level.first_more.assign(level.size + 1, 0);
  level.more.reserve(all.size());
  for (const Rest& rest : all) {
    ++level.first_more[rest.of + 1];
    level.more.push_back(rest.edge);
  }
  std::partial_sum(level.first_more.begin(), level.first_more.end(), level.first_more.begin());
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

VANTAGE_INLINE void GraphLevel::smooth(ThreadTeam& team, bool even_first) {
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

VANTAGE_INLINE void GraphLevel::smooth_from_zero(ThreadTeam& team) {
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

VANTAGE_INLINE void GraphLevel::restrict_to(ThreadTeam& team, AlignedVector<float>& sums) const {
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

VANTAGE_INLINE void GraphLevel::prolong(ThreadTeam& team, const AlignedVector<float>& correction) {
  team.split(size, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      x[i] += correction[node[i]];
    }
  });
}

VANTAGE_INLINE std::size_t GraphLevel::memory_bytes() const {
  return bytes_of(at) + bytes_of(six) + bytes_of(first_more) + bytes_of(more) + bytes_of(diagonal) + bytes_of(leak) +
         bytes_of(inverse) + bytes_of(node) + bytes_of(children) + bytes_of(first_child) + bytes_of(x) +
         bytes_of(right);
}

}  // namespace vantage::detail
