// SPDX-License-Identifier: MIT
#include "field/lanes.hpp"

namespace vantage::detail {

#if defined(__x86_64__)
InstructionSet instruction_set() {
  static const InstructionSet best = [] {
    __builtin_cpu_init();
    const bool avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
                        __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0;
    return avx512                                ? InstructionSet::Avx512
           : __builtin_cpu_supports("avx2") != 0 ? InstructionSet::Avx2
                                                 : InstructionSet::Baseline;
  }();
  return best;
}
#endif

}  // namespace vantage::detail
