// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <vantage/map/scan.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage::detail {

/// Throws std::invalid_argument, which names the field, if the pose is not rigid or the range is not positive. Shared
/// by insertion and its reference implementation.
inline void validate(const ScanView& scan) {
  if (!is_rigid(scan.world_from_sensor)) {
    throw std::invalid_argument(
        "Scan::world_from_sensor is not a rigid transform (finite, orthonormal, determinant +1)");
  }
  require_option(scan.max_range_m > 0.0, "Scan::max_range_m", scan.max_range_m, "> 0");
}

}  // namespace vantage::detail
