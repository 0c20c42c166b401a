// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>

namespace VANTAGE_EXPORT vantage {

/// A range sensor from a JSON file: one object with the fields of RangeSensor by their own names, for instance
///
///     {"projection": "pinhole", "width": 640, "height": 480, "horizontal_fov_deg": 57, "vertical_fov_deg": 43,
///      "min_range_m": 0.4, "max_range_m": 4}
///
/// `projection` is "pinhole" (the default) or "spherical". Angles may be given as `..._fov_rad` or `..._fov_deg`. A
/// pinhole has either angles of view or `fx` and `fy`, with `cx` and `cy` in the middle unless given. `width`,
/// `height` and `max_range_m` must be given. Throws std::runtime_error naming the file, the field or line, and what
/// is wrong.
[[nodiscard]] RangeSensor load_sensor(const std::filesystem::path& file);

}  // namespace vantage
