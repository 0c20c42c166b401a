// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/view/impl/sight_tree.hpp>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vantage/geometry/voxel_ray.hpp>

#include <vantage/geometry/impl/box_around.hpp>

namespace vantage::detail {

// Whether a sensor in a cell may have the start of the rays in view, or a face neighbour of it.
inline bool may_face_start(const VoxelIndex& from_start, const SightTree::MayFace& may_face) {
  return may_face(-Eigen::Vector3d(from_start.x, from_start.y, from_start.z)) ||
         std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
           const VoxelIndex line = step - from_start;
           return line == VoxelIndex{0, 0, 0} || may_face(Eigen::Vector3d(line.x, line.y, line.z));
         });
}

VANTAGE_INLINE SightTree::SightTree(const VoxelFrame& frame, std::span<const Eigen::Vector3d> directions,
                                    double furthest_m, const MayFace& may_face) {
  const VoxelIndex home{0, 0, 0};
  const Eigen::Vector3d centre = frame.centre_of(home);
  std::vector<std::vector<VoxelIndex>> rays;
  for (const Eigen::Vector3d& direction : directions) {
    std::vector<VoxelIndex>& ray = rays.emplace_back();
    for (const VoxelIndex& cell : VoxelRay(frame, centre, centre + furthest_m * direction)) {
      if (cell != home) {
        ray.push_back(cell);
      }
    }
    while (!ray.empty() && !may_face_start(ray.back(), may_face)) {
      ray.pop_back();
    }
  }
  std::vector<std::size_t> all(rays.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (!all.empty()) {
    grow(rays, all, 0);
  }
}

// Adds the branch of the rays `together` (ascending) from their step `depth` on. Returns its number.
VANTAGE_INLINE std::size_t SightTree::grow(const std::vector<std::vector<VoxelIndex>>& rays,
                                           const std::vector<std::size_t>& together, std::size_t depth) {
  const std::size_t number = branches_.size();
  branches_.push_back({together.front(), steps_.size(), 0, {}, {}});
  const auto go_on_alike = [&](std::size_t ray) {
    const std::vector<VoxelIndex>& first = rays[together.front()];
    return depth < first.size() && depth < rays[ray].size() && rays[ray][depth] == first[depth];
  };
  for (; std::all_of(together.begin(), together.end(), go_on_alike); ++depth) {
    steps_.push_back(rays[together.front()][depth]);
  }
  branches_[number].last_step = steps_.size();
  VoxelBox reach = box_around(std::span(steps_).subspan(branches_[number].first_step));
  std::vector<std::pair<VoxelIndex, std::vector<std::size_t>>> parts;
  for (const std::size_t ray : together) {
    if (depth == rays[ray].size()) {
      continue;
    }
    const auto same =
        std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first == rays[ray][depth]; });
    (same == parts.end() ? parts.emplace_back(rays[ray][depth], std::vector<std::size_t>{}) : *same)
        .second.push_back(ray);
  }
  for (const auto& [cell, part] : parts) {
    const std::size_t further = grow(rays, part, depth);
    branches_[number].further.push_back(further);
    reach = box_around(reach, branches_[further].reach);
  }
  branches_[number].reach = reach;
  return number;
}

}  // namespace vantage::detail
