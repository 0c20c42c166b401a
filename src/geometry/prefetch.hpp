// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::detail {

/// Has memory that is read soon brought near, where the compiler knows how.
inline void prefetch(const void* soon_read) {
#if defined(__GNUC__)
  __builtin_prefetch(soon_read);
#else
  (void)soon_read;
#endif
}

/// The same for memory that is written soon.
inline void prefetch_to_write(const void* soon_written) {
#if defined(__GNUC__)
  __builtin_prefetch(soon_written, 1);
#else
  (void)soon_written;
#endif
}

}  // namespace vantage::detail
