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

/// Unit directions distributed evenly over the sphere: the centres of the 20 * 4^subdivisions faces of a subdivided
/// icosahedron. Two subdivisions give the 320 directions of Vasquez-Gomez et al. 2013, VI-A. Throws
/// std::invalid_argument unless `subdivisions` is in [0, 8].
[[nodiscard]] std::vector<Eigen::Vector3d> icosahedron_directions(int subdivisions);

/// Views on spheres around `target` (world frame, metres) that look at it: all directions of `icosahedron_directions`
/// for the first radius, then for the next one. Throws std::invalid_argument unless every radius is finite and > 0,
/// and as icosahedron_directions.
[[nodiscard]] std::vector<Pose> views_around(const Eigen::Vector3d& target, std::span<const double> radii_m,
                                             int subdivisions = 2);

/// `count` random views: positions drawn uniformly from `workspace` (world frame, metres), directions uniformly from
/// the sphere. Equal seeds give equal views. Throws std::invalid_argument if the workspace is empty or not finite.
/// These are the random candidates of Vasquez-Gomez et al. 2013, VI-B, for a sensor that can take any pose.
[[nodiscard]] std::vector<Pose> random_views(const Box& workspace, std::size_t count, std::uint64_t seed);
/// Views from the same random positions that look at `target`. Errors as random_views.
[[nodiscard]] std::vector<Pose> random_views_of(const Eigen::Vector3d& target, const Box& workspace,
                                                std::size_t count, std::uint64_t seed);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/candidate_views.ipp>
#endif
