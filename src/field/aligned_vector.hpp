// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vantage::detail {

/// Memory that starts at a cache line, or at a huge page if there is enough to fill some: a field of a million cells
/// is touched so evenly that small pages cost a tenth of the time.
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
      ::madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);  // a wish: small pages do as well
    }
#endif
    return static_cast<T*>(memory);
  }
  /// Without a value, none is written: whoever uses a page first decides which processor it is near to.
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
