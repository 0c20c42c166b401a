// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/geometry/voxel.hpp>

namespace vantage {

/// What is known of the small house (`environments/aws_small_house` in `data`), at 0.1 m, after so many views that
/// `harmonic` chose for a sensor that sees all around: its known-free cells, and the one the sensor is in.
[[nodiscard]] std::pair<LaplaceDomain, VoxelIndex> house_scene(const std::filesystem::path& data, std::size_t views);

}  // namespace vantage
