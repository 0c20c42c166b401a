// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vector>

namespace vantage::detail {

/// The instruction set for which the innermost loops of insertion, ray casting and field solver are compiled. All
/// sets give bitwise equal results; the processor decides which one is used.
enum class InstructionSet : std::uint8_t { Baseline, Avx2, Avx512 };

/// The sets that this processor supports, the fastest last.
[[nodiscard]] std::vector<InstructionSet> instruction_sets();
/// The fastest supported set up to `limit`: `baseline`, `avx2`, `avx512`, or empty for no limit. Throws
/// std::invalid_argument for any other name.
[[nodiscard]] InstructionSet best_instruction_set_within(std::string_view limit);
/// The fastest supported set, limited by the environment variable VANTAGE_INSTRUCTION_SET if it is set, for
/// benchmarks. Throws as `best_instruction_set_within`.
[[nodiscard]] InstructionSet best_instruction_set();

/// \cond
#if defined(__x86_64__)
#define VANTAGE_TARGET_AVX2 [[gnu::target("avx2")]]
#define VANTAGE_TARGET_AVX512 [[gnu::target("avx512f,avx512dq,avx512vl")]]

// A local copy of the body: no store in it can alias what it holds, which matters for wide vectors.
template <class Body>
[[gnu::flatten]] VANTAGE_TARGET_AVX2 void run_avx2(const Body& body) {
  const Body local = body;  // NOLINT(performance-unnecessary-copy-initialization)
  local();
}
template <class Body>
[[gnu::flatten]] VANTAGE_TARGET_AVX512 void run_avx512(const Body& body) {
  const Body local = body;  // NOLINT(performance-unnecessary-copy-initialization)
  local();
}
#endif
/// \endcond

/// \cond
/// Marks the iterations of the following loop as independent, which a compiler cannot deduce from pointers.
#if defined(__clang__)
#define VANTAGE_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define VANTAGE_INDEPENDENT _Pragma("GCC ivdep")
#endif
/// \endcond

/// Calls `body()` compiled for `set`, with all calls in it inlined, so that loops over arrays are vectorised. The
/// library is compiled without contraction of a * b + c, so that all sets round in the same way.
template <class Body>
void compiled_for(InstructionSet set, const Body& body) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    run_avx512(body);
  } else if (set == InstructionSet::Avx2) {
    run_avx2(body);
  } else {
    body();
  }
#else
  (void)set;
  body();
#endif
}

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/instruction_set.ipp>
#endif
