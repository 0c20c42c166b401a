// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::test {

/// Whether an address sanitizer makes everything several times as slow. Laws over many random worlds then run over
/// fewer: it is how memory is used that is on trial, not how often the law holds.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace vantage::test
