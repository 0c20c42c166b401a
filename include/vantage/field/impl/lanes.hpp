// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

// Vectors wider than the registers of the baseline have no stable calling convention. Here they are only passed to
// functions that are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vantage::detail {

/// Eight numbers that are processed together: half a row of a brick, or a row of blocks.
inline constexpr std::size_t kLanes = 8;

template <class T>
struct LanesOf {
  typedef T type __attribute__((vector_size(kLanes * sizeof(T))));  // NOLINT(modernize-use-using)
};
template <class T>
using Lanes = typename LanesOf<T>::type;

// The call operator of a kernel for compiled_for must be VANTAGE_ALWAYS_INLINE: wide vectors are passed to functions
// that are inlined only.
#define VANTAGE_ALWAYS_INLINE [[gnu::always_inline]] inline
#define VANTAGE_ALWAYS_INLINE_LAMBDA __attribute__((always_inline))

template <class T>
VANTAGE_ALWAYS_INLINE Lanes<T> load(const T* from) {
  Lanes<T> lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class T>
VANTAGE_ALWAYS_INLINE void store(T* to, const Lanes<T>& lanes) {
  std::memcpy(to, &lanes, sizeof lanes);
}
template <class T>
VANTAGE_ALWAYS_INLINE Lanes<T> all(T value) {
  const Lanes<T> first{value};  // with a list of eight values, gcc 12 would emit eight insertions
  return __builtin_shufflevector(first, first, 0, 0, 0, 0, 0, 0, 0, 0);
}
/// Unpacks eight 4-bit numbers and applies `mask` to each.
template <class T>
VANTAGE_ALWAYS_INLINE Lanes<T> widen(std::uint32_t packed, std::uint32_t mask) {
  const Lanes<std::uint32_t> shift{0, 4, 8, 12, 16, 20, 24, 28};
  const Lanes<std::uint32_t> lanes = all(packed) >> shift & mask;
  return __builtin_convertvector(reinterpret_cast<const Lanes<std::int32_t>&>(lanes), Lanes<T>);
}
/// Shifts the lanes of `own` up by one and takes the first from the last lane of `below`. `shifted_down` is the
/// inverse: the last lane comes from the first lane of `above`.
template <class T>
VANTAGE_ALWAYS_INLINE Lanes<T> shifted_up(const Lanes<T>& own, const Lanes<T>& below) {
  return __builtin_shufflevector(own, below, 15, 0, 1, 2, 3, 4, 5, 6);
}
template <class T>
VANTAGE_ALWAYS_INLINE Lanes<T> shifted_down(const Lanes<T>& own, const Lanes<T>& above) {
  return __builtin_shufflevector(own, above, 1, 2, 3, 4, 5, 6, 7, 8);
}
/// The sum in a fixed order, so that it does not depend on the instruction set.
template <class T>
VANTAGE_ALWAYS_INLINE T sum_of(const Lanes<T>& lanes) {
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

/// Calls `visit` with each of 0 ... count - 1 as a compile-time constant.
template <class Visit, std::size_t... i>
VANTAGE_ALWAYS_INLINE void unrolled(Visit&& visit, std::index_sequence<i...> /*count*/) {
  (visit(std::integral_constant<std::size_t, i>{}), ...);
}

}  // namespace vantage::detail
