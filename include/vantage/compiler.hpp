// SPDX-License-Identifier: MIT
#pragma once

/// \file
/// What every public header asks of the compiler.

#if __cplusplus < 202002L
#error "vantage needs C++20: compile with -std=c++20, or let CMake do so by linking vantage::core"
#endif

/// Before the name of the namespace of every public header: a shared library shows these names, and no others.
#define VANTAGE_EXPORT [[gnu::visibility("default")]]  // NOLINT(cppcoreguidelines-macro-usage)
