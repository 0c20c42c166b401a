// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A hash table from addresses to small values, for look-ups in inner loops: open addressing with linear probing
/// (Knuth, The Art of Computer Programming, vol. 3, 6.4). Nothing is ever taken out of it but all at once.
template <class T>
class VoxelTable {
 public:
  /// The value of `key`, or null.
  [[nodiscard]] const T* find(const VoxelIndex& key) const {
    if (entries_.empty()) {
      return nullptr;
    }
    for (std::size_t at = home_of(key);; at = (at + 1) & (entries_.size() - 1)) {
      const Entry& entry = entries_[at];
      if (entry.key == key) {
        return &entry.value;
      }
      if (entry.key.x == kUnused) {
        return nullptr;
      }
    }
  }
  /// The same.
  [[nodiscard]] T* find(const VoxelIndex& key) { return const_cast<T*>(std::as_const(*this).find(key)); }
  /// The value of `key`, `fresh` where there was none. Valid until the next call.
  T& place(const VoxelIndex& key, const T& fresh = T{}) {
    if (T* known = find(key)) {
      return *known;
    }
    if (4 * (size_ + 1) > 3 * entries_.size()) {
      grow();
    }
    ++size_;
    Entry& entry = unused_entry(key);
    entry = {key, fresh};
    return entry.value;
  }
  /// How many addresses it holds.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Takes everything out.
  void clear() {
    entries_.clear();
    size_ = 0;
  }
  /// Bytes held.
  [[nodiscard]] std::size_t memory_bytes() const { return entries_.capacity() * sizeof(Entry); }

 private:
  // No address of a cell, a brick or a tile comes near.
  static constexpr std::int32_t kUnused = std::numeric_limits<std::int32_t>::min();
  struct Entry {
    VoxelIndex key{kUnused, 0, 0};
    T value{};
  };

  [[nodiscard]] std::size_t home_of(const VoxelIndex& key) const {
    return std::hash<VoxelIndex>{}(key) & (entries_.size() - 1);
  }
  Entry& unused_entry(const VoxelIndex& key) {
    std::size_t at = home_of(key);
    while (entries_[at].key.x != kUnused) {
      at = (at + 1) & (entries_.size() - 1);
    }
    return entries_[at];
  }
  void grow() {
    std::vector<Entry> entries(entries_.empty() ? 16 : 2 * entries_.size());
    std::swap(entries, entries_);
    for (const Entry& entry : entries) {
      if (entry.key.x != kUnused) {
        unused_entry(entry.key) = entry;
      }
    }
  }

  std::vector<Entry> entries_;  // a power of two of them
  std::size_t size_ = 0;
};

}  // namespace vantage
