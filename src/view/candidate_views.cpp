// SPDX-License-Identifier: MIT
#include <array>
#include <numbers>
#include <vantage/view/candidate_views.hpp>

#include "map/option_rule.hpp"

namespace vantage {
namespace {

using Face = std::array<Eigen::Vector3d, 3>;

// The corners of an icosahedron are those of three golden rectangles, one across each axis.
std::vector<Face> icosahedron() {
  constexpr double kGolden = std::numbers::phi;
  std::vector<Eigen::Vector3d> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-kGolden, kGolden}) {
      corners.insert(corners.end(), {{0.0, a, b}, {a, b, 0.0}, {b, 0.0, a}});
    }
  }
  // Corners of a face are an edge, 2, apart.
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

}  // namespace

std::vector<Eigen::Vector3d> icosahedron_directions(int subdivisions) {
  detail::require_option(subdivisions >= 0 && subdivisions <= 8, "icosahedron_directions: subdivisions", subdivisions,
                         "in [0, 8]");
  std::vector<Face> faces = icosahedron();
  for (int i = 0; i < subdivisions; ++i) {
    std::vector<Face> finer;
    finer.reserve(4 * faces.size());
    for (const auto& [a, b, c] : faces) {
      const Eigen::Vector3d ab = (a + b).normalized();
      const Eigen::Vector3d bc = (b + c).normalized();
      const Eigen::Vector3d ca = (c + a).normalized();
      finer.insert(finer.end(), {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}});
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

}  // namespace vantage
