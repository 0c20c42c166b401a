// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <map/instruction_set.hpp>
#include <string_view>

namespace vantage {

std::vector<InstructionSet> instruction_sets() {
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

InstructionSet best_instruction_set() {
  static const InstructionSet best = [] {
    const std::vector<InstructionSet> all = instruction_sets();
    const char* const limit = std::getenv("VANTAGE_INSTRUCTION_SET");
    const std::string_view name = limit == nullptr ? "" : limit;
    const InstructionSet most = name == "baseline" ? InstructionSet::Baseline
                                : name == "avx2"   ? InstructionSet::Avx2
                                                   : InstructionSet::Avx512;
    return std::min(most, all.back());
  }();
  return best;
}

}  // namespace vantage
