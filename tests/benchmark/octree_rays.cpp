// SPDX-License-Identifier: MIT
#include <array>
#include <benchmark/octree_rays.hpp>
#include <cmath>
#include <limits>

namespace vantage {
namespace {

octomap::point3d to_octomap(const Eigen::Vector3d& point) {
  const Eigen::Vector3f p = point.cast<float>();
  return {p.x(), p.y(), p.z()};
}

}  // namespace

Occupancy cast_octomap(const octomap::OcTree& tree, const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                       double range_m, octomap::point3d& end) {
  if (tree.castRay(to_octomap(from), to_octomap(along), end, false, range_m)) {
    return Occupancy::Occupied;
  }
  return tree.search(end) == nullptr ? Occupancy::Unknown : Occupancy::Free;
}

RayEnd cast_octomap_at(const octomap::OcTree& tree, int level, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& along, double range_m) {
  constexpr std::int32_t kOrigin = 32768;
  const double size_m = tree.getResolution() * (1 << level);
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::array<std::int32_t, 3> cell{};
  std::array<std::int32_t, 3> step{};
  std::array<double, 3> next_m{};
  std::array<double, 3> apart_m{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    cell[axis] = static_cast<std::int32_t>(std::floor(from[i] / size_m));
    step[axis] = along[i] > 0.0 ? 1 : -1;
    const double face_m = (cell[axis] + (along[i] > 0.0 ? 1 : 0)) * size_m;
    const double speed = std::abs(along[i]);
    next_m[axis] = speed > 0.0 ? std::abs(face_m - from[i]) / speed : kNever;
    apart_m[axis] = size_m / speed;
  }
  while (true) {
    const auto key = [level](std::int32_t c) { return static_cast<octomap::key_type>((c << level) + kOrigin); };
    const octomap::OcTreeNode* const node =
        tree.search(octomap::OcTreeKey(key(cell[0]), key(cell[1]), key(cell[2])), 16U - static_cast<unsigned>(level));
    const VoxelIndex at{cell[0], cell[1], cell[2]};
    if (node == nullptr || tree.isNodeOccupied(node)) {
      return {at, node == nullptr ? Occupancy::Unknown : Occupancy::Occupied};
    }
    const std::size_t xy = next_m[1] < next_m[0] ? 1 : 0;
    const std::size_t axis = next_m[2] < next_m[xy] ? 2 : xy;
    if (next_m[axis] > range_m) {
      return {at, Occupancy::Free};
    }
    cell[axis] += step[axis];
    next_m[axis] += apart_m[axis];
  }
}

bool meets(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  const Eigen::Array3d a = (box.min - from).array() / along.array();
  const Eigen::Array3d b = (box.max - from).array() / along.array();
  return std::max(a.min(b).maxCoeff(), 0.0) <= a.max(b).minCoeff();
}

Occupancy counted_inside(const Box& box, const VoxelFrame& frame, const RayEnd& end) {
  const Box cell = frame.box_of(end.cell);
  const bool meets = (cell.min.array() < box.max.array()).all() && (cell.max.array() > box.min.array()).all();
  return meets ? end.occupancy : Occupancy::Free;
}

}  // namespace vantage
