// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/picture/picture.hpp>

namespace VANTAGE_EXPORT vantage {

/// Renders depths, row by row from the top left, in colours: near is light, far is dark, and what is not finite is
/// grey. Depths are clamped to [near_m, far_m]. Throws std::invalid_argument unless near_m < far_m and there are
/// depths, in whole rows of `width`.
[[nodiscard]] Picture draw_depth(std::span<const float> depths_m, std::size_t width, double near_m, double far_m);

}  // namespace vantage
