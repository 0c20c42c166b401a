// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vantage/map/impl/instruction_set.hpp>

namespace vantage::detail {

VANTAGE_INLINE std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::Baseline};
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") != 0) {
    sets.push_back(InstructionSet::Avx2);
    if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
        __builtin_cpu_supports("avx512vl") != 0) {
      sets.push_back(InstructionSet::Avx512);
    }
  }
#endif
  return sets;
}

VANTAGE_INLINE InstructionSet best_instruction_set_within(std::string_view limit) {
  if (!limit.empty() && limit != "baseline" && limit != "avx2" && limit != "avx512") {
    throw std::invalid_argument(
        std::string("VANTAGE_INSTRUCTION_SET is ").append(limit).append(", must be baseline, avx2 or avx512"));
  }
  const InstructionSet most = limit == "baseline" ? InstructionSet::Baseline
                              : limit == "avx2"   ? InstructionSet::Avx2
                                                  : InstructionSet::Avx512;
  return std::min(most, instruction_sets().back());
}

VANTAGE_INLINE InstructionSet best_instruction_set() {
  static const InstructionSet best = [] {
    const char* const limit = std::getenv("VANTAGE_INSTRUCTION_SET");
    return best_instruction_set_within(limit == nullptr ? "" : limit);
  }();
  return best;
}

}  // namespace vantage::detail
