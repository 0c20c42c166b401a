// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vantage/geometry/voxel_ray.hpp>

namespace vantage::detail {

/// The crossings of one axis for a segment from the coordinate `from`, in cell `first`, to `to`, in cell `last`.
/// Metres; `size_m` is the edge of a cell.
///
/// Use it only in compiled sources of the library. A compiler that fuses operations such as `face_m - from` into one
/// rounding would compute different times.
[[nodiscard]] inline FaceCrossings crossings_between(double from, double to, std::int32_t first, std::int32_t last,
                                                     double size_m) {
  if (first == last) {
    return {FaceCrossings::kNever, 0};
  }
  constexpr auto kUnit = static_cast<double>(FaceCrossings::kEnd);
  const double per_metre = std::min(kUnit / std::abs(to - from), 1e200);
  const bool up = last > first;
  const double face_m = (first + (up ? 1 : 0)) * size_m;
  const double next = (up ? face_m - from : from - face_m) * per_metre;
  const FaceCrossings crossings{static_cast<std::int64_t>(std::clamp(next, 0.0, kUnit)),
                                static_cast<std::int64_t>(std::min(size_m * per_metre, 2.0 * kUnit))};
  return crossings.ending_after(std::abs(last - first));
}

}  // namespace vantage::detail
