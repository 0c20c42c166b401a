// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vantage/view/candidate_views.hpp>

#include <vantage/geometry/impl/dice.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

using Face = std::array<Eigen::Vector3d, 3>;

// The corners of an icosahedron are those of three golden rectangles, one across each axis.
inline std::vector<Face> icosahedron() {
  constexpr double kGolden = std::numbers::phi;
  std::vector<Eigen::Vector3d> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-kGolden, kGolden}) {
      corners.insert(corners.end(), {{0.0, a, b}, {a, b, 0.0}, {b, 0.0, a}});
    }
  }
  // The corners of a face are one edge length, 2, apart.
  const auto neighbours = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return (p - q).norm() < 2.1; };
  std::vector<Face> faces;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        if (neighbours(corners[i], corners[j]) && neighbours(corners[j], corners[k]) &&
            neighbours(corners[k], corners[i])) {
          faces.push_back({corners[i].normalized(), corners[j].normalized(), corners[k].normalized()});
        }
      }
    }
  }
  return faces;
}

// Creates views at random positions of a workspace. `look(position, random direction)` returns the viewing direction.
template <class Look>
std::vector<Pose> drawn_views(const Box& workspace, std::size_t count, std::uint64_t seed, const Look& look) {
  if (workspace.empty() || !workspace.min.allFinite() || !workspace.max.allFinite()) {
    throw std::invalid_argument("random views: the workspace must have min < max on every axis and be finite");
  }
  Dice dice(seed);
  std::vector<Pose> views;
  views.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = dice.share();
    const double y = dice.share();
    const double z = dice.share();
    const Eigen::Vector3d place = workspace.min + Eigen::Vector3d(x, y, z).cwiseProduct(workspace.extent());
    views.push_back(pose_looking_along(place, look(place, dice.direction())));
  }
  return views;
}

}  // namespace detail

VANTAGE_INLINE std::vector<Eigen::Vector3d> icosahedron_directions(int subdivisions) {
  detail::require_option(subdivisions >= 0 && subdivisions <= 8, "icosahedron_directions: subdivisions", subdivisions,
                         "in [0, 8]");
  std::vector<detail::Face> faces = detail::icosahedron();
  for (int i = 0; i < subdivisions; ++i) {
    std::vector<detail::Face> finer;
    finer.reserve(4 * faces.size());
    for (const auto& [a, b, c] : faces) {
      const Eigen::Vector3d ab = (a + b).normalized();
      const Eigen::Vector3d bc = (b + c).normalized();
      const Eigen::Vector3d ca = (c + a).normalized();
      finer.insert(finer.end(), {detail::Face{a, ab, ca}, detail::Face{ab, b, bc}, detail::Face{ca, bc, c},
                                 detail::Face{ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(faces.size());
  for (const auto& [a, b, c] : faces) {
    directions.push_back((a + b + c).normalized());
  }
  return directions;
}

VANTAGE_INLINE std::vector<Pose> views_around(const Eigen::Vector3d& target, std::span<const double> radii_m,
                                              int subdivisions) {
  std::vector<Pose> views;
  const std::vector<Eigen::Vector3d> directions = icosahedron_directions(subdivisions);
  for (const double radius_m : radii_m) {
    detail::require_option(std::isfinite(radius_m) && radius_m > 0.0, "views_around: radius_m", radius_m, "> 0");
    for (const Eigen::Vector3d& direction : directions) {
      views.push_back(pose_looking_along(target + radius_m * direction, -direction));
    }
  }
  return views;
}

VANTAGE_INLINE std::vector<Pose> random_views(const Box& workspace, std::size_t count, std::uint64_t seed) {
  return detail::drawn_views(workspace, count, seed,
                             [](const Eigen::Vector3d&, const Eigen::Vector3d& drawn) { return drawn; });
}

VANTAGE_INLINE std::vector<Pose> random_views_of(const Eigen::Vector3d& target, const Box& workspace,
                                                 std::size_t count, std::uint64_t seed) {
  return detail::drawn_views(workspace, count, seed, [&](const Eigen::Vector3d& place, const Eigen::Vector3d& drawn) {
    return place == target ? drawn : Eigen::Vector3d(target - place);
  });
}

}  // namespace vantage
