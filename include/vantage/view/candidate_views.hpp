// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vantage {

/// Unit directions all around, evenly spread: the middles of the 20 * 4^subdivisions faces of an icosahedron whose
/// faces are divided into four, again and again, and put on the sphere. Two subdivisions give the 320 directions of
/// Vasquez-Gomez et al. 2013, VI-A. Throws std::invalid_argument unless `subdivisions` is in [0, 8].
[[nodiscard]] std::vector<Eigen::Vector3d> icosahedron_directions(int subdivisions);

}  // namespace vantage
