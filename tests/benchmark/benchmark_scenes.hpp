// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/map/scan.hpp>

namespace vantage {

/// A pinhole depth image (f = 525 px at 640 columns) of a laid table in a closed room of 4 x 4 x 3.2 m, seen from a
/// corner at 1.5 m. Depths carry the seeded noise of a structured-light camera, 1 mm at 1 m and growing with its
/// square.
[[nodiscard]] Scan table_scan(std::size_t width = 640, std::size_t height = 480, std::uint32_t seed = 1);

/// A scan of a lidar of 64 x 1,024 rays and a range of 20 m in a hall of 36 x 18 x 7 m with pillars and crates, its
/// points shuffled: an unorganised scan.
[[nodiscard]] Scan hall_scan(std::uint32_t seed = 1);

}  // namespace vantage
