// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/geometry/voxel.hpp>

namespace vantage {

/// The known free cells, at 0.1 m, of the small house (`environments/aws_small_house` in `data`) after this many
/// views of `harmonic` with a sensor that sees all around, and the cell of the sensor.
[[nodiscard]] std::pair<LaplaceDomain, VoxelIndex> house_scene(const std::filesystem::path& data, std::size_t views);

}  // namespace vantage
