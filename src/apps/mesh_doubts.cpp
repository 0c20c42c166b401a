// SPDX-License-Identifier: MIT
#include "apps/mesh_doubts.hpp"

#include <algorithm>
#include <sstream>

namespace vantage::apps {
namespace {

std::string doubt_about_unit(const std::string& file, const Box& bounds, double furthest_m) {
  const double longest_m = bounds.extent().maxCoeff();
  if (longest_m <= furthest_m) {
    return "";
  }
  std::ostringstream doubt;
  doubt << file << " is " << longest_m
        << " m long; if its unit is not the metre, say so: --scale 0.001 for millimetres\n";
  return doubt.str();
}

std::string doubt_about_axis(const std::string& file, const Box& bounds) {
  const Eigen::Vector3d extent = bounds.extent();
  if (extent.z() <= std::min(extent.x(), extent.y())) {
    return "";
  }
  std::ostringstream doubt;
  doubt << file << " is higher than wide, " << extent.x() << " x " << extent.y() << " x " << extent.z()
        << " m; if it lies on its side, say which axis of the file points up: --up y, or --up z where it stands\n";
  return doubt.str();
}

}  // namespace

std::string doubt_about_object_unit(const std::string& file, const Box& bounds) {
  return doubt_about_unit(file, bounds, 5.0);
}

std::string doubts_about_world(const ExploreRequest& request, const Box& bounds) {
  if (!is_world_file(request, World::FileKind::Mesh)) {
    return "";
  }
  return (request.scale.value_or(1.0) == 1.0 ? doubt_about_unit(request.world, bounds, 2000.0) : "") +
         (request.up.empty() ? doubt_about_axis(request.world, bounds) : "");
}

}  // namespace vantage::apps
