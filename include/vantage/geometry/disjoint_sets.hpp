// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Union-find: a partition of 0 .. size - 1 into sets that can be merged. It uses union by size and path halving, so
/// a call takes nearly constant time. (Tarjan 1975.)
class DisjointSets {
 public:
  /// Every element forms its own set.
  explicit DisjointSets(std::size_t size) : parent_(size), size_(size, 1), count_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// The number of elements.
  [[nodiscard]] std::size_t size() const { return parent_.size(); }
  /// The number of sets.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// The representative of the set of `element`. It may change at the next merge.
  [[nodiscard]] std::size_t find(std::size_t element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }
  /// Whether two elements are in the same set.
  [[nodiscard]] bool same(std::size_t a, std::size_t b) { return find(a) == find(b); }
  /// Merges the sets of two elements. Returns false if they were in the same set already.
  bool merge(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b) {
      return false;
    }
    if (size_[a] < size_[b]) {
      std::swap(a, b);
    }
    parent_[b] = a;
    size_[a] += size_[b];
    --count_;
    return true;
  }
  /// The number of the set of every element. Sets are numbered from 0 in the order of their first element, so the
  /// labels depend only on the partition and not on the order of the merges.
  [[nodiscard]] std::vector<std::size_t> labels() {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> label_of_root(size(), kNone);
    std::vector<std::size_t> labels(size());
    std::size_t next = 0;
    for (std::size_t element = 0; element < size(); ++element) {
      std::size_t& label = label_of_root[find(element)];
      if (label == kNone) {
        label = next++;
      }
      labels[element] = label;
    }
    return labels;
  }

 private:
  std::vector<std::size_t> parent_;
  std::vector<std::size_t> size_;
  std::size_t count_;
};

}  // namespace vantage
