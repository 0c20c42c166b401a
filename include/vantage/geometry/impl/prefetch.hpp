// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::detail {

/// Prefetches memory that will be read soon, if the compiler supports it.
inline void prefetch(const void* soon_read) {
#if defined(__GNUC__)
  __builtin_prefetch(soon_read);
#else
  (void)soon_read;
#endif
}

/// Prefetches memory that will be written soon.
inline void prefetch_to_write(const void* soon_written) {
#if defined(__GNUC__)
  __builtin_prefetch(soon_written, 1);
#else
  (void)soon_written;
#endif
}

}  // namespace vantage::detail
