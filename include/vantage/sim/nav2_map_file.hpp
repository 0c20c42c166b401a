// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/sim/ground_plan.hpp>

namespace VANTAGE_EXPORT vantage {

/// Reads a map of nav2 or of ROS 1's map_server: a YAML file with `image` (a PGM file, plain or binary, beside
/// it), `resolution` (metres per pixel), `origin` ([x, y, yaw] of the lower left corner), `negate`,
/// `occupied_thresh` and `free_thresh`. `mode`, if given, must be trinary; other keys are ignored. With the
/// darkness p of a pixel in [0, 1] (its brightness if `negate`), p < free_thresh is free; everything else,
/// occupied or unknown, is solid. Throws std::runtime_error with the path and the error.
[[nodiscard]] GroundPlan read_nav2_map(const std::filesystem::path& path);

}  // namespace vantage
