// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::test {

/// Whether an address sanitizer is on, which makes everything several times slower. Laws over many random worlds
/// then use fewer of them: the sanitizer checks the use of memory, not how often a law holds.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace vantage::test
