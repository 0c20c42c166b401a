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

/// A hash table from cell addresses to small values, for lookups in inner loops. It uses open addressing with linear
/// probing (Knuth, The Art of Computer Programming, vol. 3, 6.4). Single entries cannot be removed.
template <class T>
class VoxelTable {
 public:
  /// The value of `key`, or null if there is none.
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
  /// The value of `key`, to write to, or null if there is none.
  [[nodiscard]] T* find(const VoxelIndex& key) { return const_cast<T*>(std::as_const(*this).find(key)); }
  /// The value of `key`; `fresh` is inserted if there is none. The reference is valid until the next call.
  T& place(const VoxelIndex& key, const T& fresh = T{}) {
    if (T* known = find(key)) {
      return *known;
    }
    if (is_full()) {
      grow();
    }
    ++size_;
    Entry& entry = unused_entry(key);
    entry = {key, fresh};
    return entry.value;
  }
  /// The number of entries.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Removes all entries.
  void clear() {
    entries_.clear();
    size_ = 0;
  }
  /// Memory in use, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const { return entries_.capacity() * sizeof(Entry); }
  /// What `memory_bytes` will be after one more entry.
  [[nodiscard]] std::size_t memory_with_another() const {
    return is_full() ? slots_after_growth() * sizeof(Entry) : memory_bytes();
  }

 private:
  // marks an unused entry; no valid address has this value
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
  [[nodiscard]] bool is_full() const { return 4 * (size_ + 1) > 3 * entries_.size(); }
  [[nodiscard]] std::size_t slots_after_growth() const { return entries_.empty() ? 16 : 2 * entries_.size(); }
  void grow() {
    std::vector<Entry> entries(slots_after_growth());
    std::swap(entries, entries_);
    for (const Entry& entry : entries) {
      if (entry.key.x != kUnused) {
        unused_entry(entry.key) = entry;
      }
    }
  }

  std::vector<Entry> entries_;  // the size is a power of two
  std::size_t size_ = 0;
};

}  // namespace vantage
