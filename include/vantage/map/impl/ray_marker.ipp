// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vantage/map/impl/ray_marker.hpp>

#include <vantage/geometry/impl/face_crossings.hpp>

namespace vantage::detail {

VANTAGE_INLINE RayMarker::RayMarker(const VoxelFrame& frame, const Eigen::Vector3d& origin, ScanMarks& marks)
    : frame_(frame),
      origin_(origin),
      first_(frame.cell_of(origin)),
      starts_in_window_(marks.in_window(first_)),
      marks_(marks) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes_.mask[axis] = static_cast<std::int64_t>(marks.mask(axis));
  }
}

VANTAGE_INLINE void RayMarker::park(std::size_t lane) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes_.at[axis][lane] = lanes_.step[axis][lane] = lanes_.next[axis][lane] = lanes_.delta[axis][lane] = 0;
  }
  lanes_.base[lane] = static_cast<std::int64_t>(marks_.nowhere());
  left_[lane] = kNoRay;
}

// nullopt if no cell of the part lies in the window.
VANTAGE_INLINE std::optional<RayMarker::Part> RayMarker::within_window(const DrawnRay& ray, const Crossings& faces,
                                                                       Part part) const {
  const VoxelBox& window = marks_.window();
  const std::array<std::int32_t, 3> first{first_.x, first_.y, first_.z};
  const std::array<std::int32_t, 3> last{ray.last.x, ray.last.y, ray.last.z};
  const std::array<std::int32_t, 3> lo{window.lo.x, window.lo.y, window.lo.z};
  const std::array<std::int32_t, 3> hi{window.hi.x, window.hi.y, window.hi.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool up = last[axis] > first[axis];
    const std::int64_t all = std::abs(last[axis] - first[axis]);
    // faces crossed before the window
    const std::int64_t into = up ? lo[axis] - first[axis] : first[axis] - hi[axis] + 1;
    // faces crossed up to leaving the window
    const std::int64_t out = up ? hi[axis] - first[axis] : first[axis] - lo[axis] + 1;
    if (into > all || out <= 0) {
      return std::nullopt;
    }
    const auto crossing = [&](std::int64_t face) {
      return Crossing{faces[axis].next + (face - 1) * faces[axis].delta, axis};
    };
    if (into > 0) {
      part.enters = std::max(part.enters, crossing(into));
    }
    if (out <= all) {
      part.leaves = part.leaves ? std::min(*part.leaves, crossing(out)) : crossing(out);
    }
  }
  return part.leaves && *part.leaves <= part.enters ? std::nullopt : std::optional(part);
}

VANTAGE_INLINE void RayMarker::start(std::size_t lane, const DrawnRay& ray) {
  const bool in_window = starts_in_window_ && marks_.in_window(ray.last);
  if (!in_window && !marks_.holds_clip()) {
    mark_far(ray);
    return;
  }
  const std::array<std::int32_t, 3> first{first_.x, first_.y, first_.z};
  const std::array<std::int32_t, 3> last{ray.last.x, ray.last.y, ray.last.z};
  Crossings faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    faces[axis] = crossings_between(origin_[i], ray.end[i], first[axis], last[axis], frame_.size_m);
  }
  std::optional<Part> part(std::in_place);
  if (ray.faces_before > 0) {
    part->enters = {faces[ray.axis].next + (ray.faces_before - 1) * faces[ray.axis].delta, ray.axis};
  }
  left_[lane] = 0;
  if (!in_window) {
    part = within_window(ray, faces, *part);
  }
  if (!part) {
    return;
  }
  lanes_.base[lane] = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Number of faces crossed up to and including this crossing.
    const auto crossed_by = [&](const Crossing& one) {
      return one.time < 0 ? 0 : faces[axis].crossed_by(one.time - (axis > one.axis ? 1 : 0));
    };
    const std::int64_t crossed = crossed_by(part->enters);
    const bool up = last[axis] > first[axis];
    const auto at = static_cast<std::int32_t>(first[axis] + (up ? crossed : -crossed));
    const std::uint64_t mask = marks_.mask(axis);
    const std::uint64_t one = std::uint64_t{1} << 2U * axis;
    lanes_.at[axis][lane] = static_cast<std::int64_t>(marks_.part(axis, at));
    lanes_.step[axis][lane] = static_cast<std::int64_t>(up ? ~mask + one : ~one + 1);
    lanes_.next[axis][lane] = faces[axis].next + crossed * faces[axis].delta;
    lanes_.delta[axis][lane] = faces[axis].delta;
    left_[lane] += part->leaves ? crossed_by(*part->leaves) - crossed : std::abs(last[axis] - at);
  }
}

VANTAGE_INLINE void RayMarker::mark_far(const DrawnRay& ray) {
  for (const VoxelIndex& cell : VoxelRay(frame_, origin_, ray.end)) {
    if (cell != ray.last && !marks_.leaves_out(cell)) {
      marks_.mark_passed(cell);
    }
  }
}

}  // namespace vantage::detail
