// SPDX-License-Identifier: MIT
#pragma once

/// \file
/// What every public header asks of the compiler.

#if __cplusplus < 202002L
#error "vantage needs C++20: compile with -std=c++20, or let CMake do so by linking vantage::core"
#endif

// A fused multiply-add rounds once where the library rounds twice, and no macro tells whether the compiler makes one.
#if defined(VANTAGE_HEADER_ONLY) && !defined(VANTAGE_CONTRACTS_NOTHING) && \
    (defined(__FP_FAST_FMA) || defined(__FMA__) || defined(__ARM_FEATURE_FMA))
#error "vantage, header-only with FMA: link vantage::headers, or add -ffp-contract=off -DVANTAGE_CONTRACTS_NOTHING"
#endif

/// Before the name of the namespace of every public header: a shared library shows these names, and no others.
#define VANTAGE_EXPORT [[gnu::visibility("default")]]  // NOLINT(cppcoreguidelines-macro-usage)

/// Before each function that a file of a folder impl/ defines. These files are compiled once, into vantage::core, or,
/// where VANTAGE_HEADER_ONLY is defined (vantage::headers), included by the headers that declare their functions.
#if defined(VANTAGE_HEADER_ONLY)
#define VANTAGE_INLINE inline  // NOLINT(cppcoreguidelines-macro-usage)
#else
#define VANTAGE_INLINE
#endif
