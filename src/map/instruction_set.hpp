// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace vantage {

/// What the innermost loops of insertion, of ray casting and of the field are compiled for. All give the same bits;
/// the processor decides which one runs.
enum class InstructionSet : std::uint8_t { Baseline, Avx2, Avx512 };

/// Those this processor has, the fastest last.
[[nodiscard]] std::vector<InstructionSet> instruction_sets();
/// The fastest of them, none beyond `limit`: `baseline`, `avx2` or `avx512`, or nothing for no limit. Throws
/// std::invalid_argument for any other name.
[[nodiscard]] InstructionSet best_instruction_set_within(std::string_view limit);
/// The fastest of them within VANTAGE_INSTRUCTION_SET of the environment, if that is set, for timing the others.
/// Throws as `best_instruction_set_within`.
[[nodiscard]] InstructionSet best_instruction_set();

/// \cond
#if defined(__x86_64__)
#define VANTAGE_TARGET_AVX2 [[gnu::target("avx2")]]
#define VANTAGE_TARGET_AVX512 [[gnu::target("avx512f,avx512dq,avx512vl")]]

namespace detail {
template <class Body>
[[gnu::flatten]] VANTAGE_TARGET_AVX2 void run_avx2(const Body& body) {
  body();
}
template <class Body>
[[gnu::flatten]] VANTAGE_TARGET_AVX512 void run_avx512(const Body& body) {
  body();
}
}  // namespace detail
#endif
/// \endcond

/// \cond
/// Before a loop over arrays: its passes do not depend on each other, which compilers cannot tell from pointers.
#if defined(__clang__)
#define VANTAGE_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define VANTAGE_INDEPENDENT _Pragma("GCC ivdep")
#endif
/// \endcond

/// Calls `body()`, in which every call is inlined and compiled for `set`: loops over arrays become vectors. The
/// library is compiled without contraction of a * b + c, so that all sets round alike.
template <class Body>
void compiled_for(InstructionSet set, const Body& body) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    detail::run_avx512(body);
  } else if (set == InstructionSet::Avx2) {
    detail::run_avx2(body);
  } else {
    body();
  }
#else
  (void)set;
  body();
#endif
}

}  // namespace vantage
