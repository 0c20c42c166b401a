// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/voxel_ray.hpp>

#include <vantage/geometry/impl/face_crossings.hpp>

namespace vantage {

VANTAGE_INLINE VoxelRay::VoxelRay(const VoxelFrame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const VoxelIndex first = frame.cell_of(from);
  const VoxelIndex last = frame.cell_of(to);
  cell_ = {first.x, first.y, first.z};
  const std::array<std::int32_t, 3> end{last.x, last.y, last.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    steps_ += std::abs(end[axis] - cell_[axis]);
    sign_[axis] = end[axis] >= cell_[axis] ? 1 : -1;
    faces_[axis] = detail::crossings_between(from[i], to[i], cell_[axis], end[axis], frame.size_m);
  }
}

}  // namespace vantage
