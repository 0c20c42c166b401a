// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Unit directions all around, evenly spread: the middles of the 20 * 4^subdivisions faces of an icosahedron whose
/// faces are divided into four, again and again, and put on the sphere. Two subdivisions give the 320 directions of
/// Vasquez-Gomez et al. 2013, VI-A. Throws std::invalid_argument unless `subdivisions` is in [0, 8].
[[nodiscard]] std::vector<Eigen::Vector3d> icosahedron_directions(int subdivisions);

/// Views from shells around `target`, all looking at it: from every direction of `icosahedron_directions`, at each of
/// the radii in turn. Throws std::invalid_argument unless every radius is > 0; and as icosahedron_directions.
[[nodiscard]] std::vector<Pose> views_around(const Eigen::Vector3d& target, std::span<const double> radii_m,
                                             int subdivisions = 2);

/// `count` views from places drawn evenly from `workspace`, looking in directions drawn evenly from all there are:
/// the random candidates of Vasquez-Gomez et al. 2013, VI-B, for a platform that can be anywhere and turn anyhow. The
/// same seed gives the same views. Throws std::invalid_argument if the workspace is empty or not finite.
[[nodiscard]] std::vector<Pose> random_views(const Box& workspace, std::size_t count, std::uint64_t seed);
/// The same places, all looking at `target`.
[[nodiscard]] std::vector<Pose> random_views_of(const Eigen::Vector3d& target, const Box& workspace,
                                                std::size_t count, std::uint64_t seed);

}  // namespace vantage
