// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/sim/ground_plan.hpp>

namespace VANTAGE_EXPORT vantage {

/// A map as nav2's and ROS 1's map_server keep it: a YAML file with `image` (a PGM file, plain or binary, beside it),
/// `resolution` (metres a pixel), `origin` ([x, y, yaw] of the lower left corner), `negate`, `occupied_thresh`,
/// `free_thresh`, and `mode`, which must be trinary where it is given; other keys are ignored, as there. With p the
/// darkness of a pixel in [0, 1] (its brightness if `negate`), p < free_thresh is free and all else, occupied or not
/// known, is solid. Throws std::runtime_error naming the file and what is wrong with it.
[[nodiscard]] GroundPlan read_nav2_map(const std::filesystem::path& path);

}  // namespace vantage
