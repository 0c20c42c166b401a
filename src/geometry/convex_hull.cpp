// SPDX-License-Identifier: MIT
extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <vantage/geometry/convex_hull.hpp>

#include "geometry/plane_distance.hpp"

namespace vantage {
namespace {

// Index of the point with the largest distance.
template <class Distance>
std::size_t furthest(const std::vector<Eigen::Vector3d>& points, const Distance& distance) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    best = distance(points[i]) > distance(points[best]) ? i : best;
  }
  return best;
}

// Why the points span no volume; empty if they do. Tested before Qhull runs, because Qhull's error text is very long.
std::string flatness(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 4) {
    return "there are fewer than four points";
  }
  const Eigen::Vector3d& a = points[0];
  const Eigen::Vector3d b = points[furthest(points, [&](const auto& p) { return (p - a).norm(); })];
  const double length = (b - a).norm();
  const double flat = 1e-9 * std::max(length, a.cwiseAbs().maxCoeff());
  if (length <= flat) {
    return "all points are one";
  }
  const Eigen::Vector3d along = (b - a) / length;
  const auto off_line = [&](const auto& p) { return (p - a).cross(along).norm(); };
  const Eigen::Vector3d& c = points[furthest(points, off_line)];
  if (off_line(c) <= flat) {
    return "all points lie on one line";
  }
  const Eigen::Vector3d normal = along.cross(c - a).normalized();
  const auto off_plane = [&](const auto& p) { return std::abs((p - a).dot(normal)); };
  return off_plane(points[furthest(points, off_plane)]) <= flat ? "all points lie in one plane" : "";
}

struct FreeQhull {
  void operator()(qhT* qhull) const {
    qh_freeqhull(qhull, qh_ALL);
    int current = 0;
    int total = 0;
    qh_memfreeshort(qhull, &current, &total);
    delete qhull;
  }
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

ConvexHull::ConvexHull(const std::vector<Eigen::Vector3d>& points) {
  if (!std::all_of(points.begin(), points.end(), [](const Eigen::Vector3d& point) { return point.allFinite(); })) {
    throw std::invalid_argument("ConvexHull: every coordinate must be finite");
  }
  reason_ = flatness(points);
  if (!reason_.empty()) {
    return;
  }
  // Coordinates relative to the first point: far from the origin, the offsets of the planes would lose digits.
  const Eigen::Vector3d& origin = points.front();
  std::vector<coordT> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d local = point - origin;
    coordinates.insert(coordinates.end(), local.data(), local.data() + 3);
  }
  // Qhull needs an output file; stderr is not allowed
  const std::unique_ptr<std::FILE, CloseFile> messages(std::tmpfile());
  if (messages == nullptr) {
    throw std::runtime_error("ConvexHull: no temporary file could be opened");
  }
  const std::unique_ptr<qhT, FreeQhull> qhull(new qhT{});
  qh_zero(qhull.get(), messages.get());
  std::string command = "qhull";
  const int error = qh_new_qhull(qhull.get(), 3, static_cast<int>(points.size()), coordinates.data(), False,
                                 command.data(), nullptr, messages.get());
  if (error != 0) {
    reason_ = "Qhull gave up with error " + std::to_string(error);
    return;
  }
  for (const facetT* facet = qhull->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
    const Eigen::Vector3d normal(facet->normal[0], facet->normal[1], facet->normal[2]);
    planes_.push_back({normal, facet->offset - normal.dot(origin)});
  }
  for (const vertexT* vertex = qhull->vertex_list; vertex != nullptr && vertex->next != nullptr;
       vertex = vertex->next) {
    corners_.push_back(points[static_cast<std::size_t>(qh_pointid(qhull.get(), vertex->point))]);
  }
}

bool ConvexHull::contains(const Eigen::Vector3d& point, double tolerance) const {
  return !empty() && std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    return detail::distance_from(plane, point) <= tolerance;
  });
}

}  // namespace vantage
