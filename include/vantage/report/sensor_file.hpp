// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>

namespace VANTAGE_EXPORT vantage {

/// Reads a range sensor from a JSON file: one object whose keys are the fields of RangeSensor, for example
///
///     {"projection": "pinhole", "width": 640, "height": 480, "horizontal_fov_deg": 57, "vertical_fov_deg": 43,
///      "min_range_m": 0.4, "max_range_m": 4}
///
/// `width`, `height` and `max_range_m` are required. `projection` is "pinhole" (default) or "spherical". Angles
/// are `..._fov_rad` or `..._fov_deg`. A pinhole has either angles of view or `fx` and `fy`; `cx` and `cy` default
/// to the middle. Throws std::runtime_error with the path, the field or line, and the error.
[[nodiscard]] RangeSensor load_sensor(const std::filesystem::path& file);

}  // namespace vantage
