// SPDX-License-Identifier: MIT
#include <cmath>
#include <map/ray_marker.hpp>
#include <vantage/geometry/voxel_ray.hpp>

#include "geometry/face_crossings.hpp"

namespace vantage {

RayMarker::RayMarker(const VoxelFrame& frame, const Eigen::Vector3d& origin, ScanMarks& marks)
    : frame_(frame), origin_(origin), first_(frame.cell_of(origin)), marks_(marks) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes_.mask[axis] = static_cast<std::int64_t>(marks.mask(axis));
  }
}

void RayMarker::park(std::size_t lane) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes_.at[axis][lane] = lanes_.step[axis][lane] = lanes_.next[axis][lane] = lanes_.delta[axis][lane] = 0;
  }
  lanes_.base[lane] = static_cast<std::int64_t>(marks_.nowhere());
  left_[lane] = kNoRay;
}

void RayMarker::start(std::size_t lane, const DrawnRay& ray) {
  if (!marks_.in_window(ray.last)) {
    mark_far(ray);
    return;
  }
  const std::array<std::int32_t, 3> first{first_.x, first_.y, first_.z};
  const std::array<std::int32_t, 3> last{ray.last.x, ray.last.y, ray.last.z};
  std::array<FaceCrossings, 3> faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    faces[axis] = detail::crossings_between(origin_[i], ray.end[i], first[axis], last[axis], frame_.size_m);
  }
  const bool from_origin = ray.faces_before == 0;
  const std::int64_t start_time =
      from_origin ? -1 : faces[ray.axis].next + (ray.faces_before - 1) * faces[ray.axis].delta;
  lanes_.base[lane] = 0;
  left_[lane] = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Of faces crossed at the same time, that across the lower axis comes first.
    const std::int64_t crossed = from_origin ? 0 : faces[axis].crossed_by(start_time - (axis > ray.axis ? 1 : 0));
    const bool up = last[axis] > first[axis];
    const auto at = static_cast<std::int32_t>(first[axis] + (up ? crossed : -crossed));
    const std::uint64_t mask = marks_.mask(axis);
    const std::uint64_t one = std::uint64_t{1} << 2U * axis;
    lanes_.at[axis][lane] = static_cast<std::int64_t>(marks_.part(axis, at));
    lanes_.step[axis][lane] = static_cast<std::int64_t>(up ? ~mask + one : ~one + 1);
    lanes_.next[axis][lane] = faces[axis].next + crossed * faces[axis].delta;
    lanes_.delta[axis][lane] = faces[axis].delta;
    left_[lane] += std::abs(last[axis] - at);
  }
}

void RayMarker::mark_far(const DrawnRay& ray) {
  for (const VoxelIndex& cell : VoxelRay(frame_, origin_, ray.end)) {
    if (cell != ray.last) {
      marks_.mark_passed(cell);
    }
  }
}

}  // namespace vantage
