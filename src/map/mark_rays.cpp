// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <map/mark_rays.hpp>
#include <map/ray_lanes.hpp>
#include <vantage/geometry/voxel_ray.hpp>

namespace vantage {
namespace {

class RayMarker {
 public:
  RayMarker(const VoxelFrame& frame, const Eigen::Vector3d& origin, ScanMarks& marks)
      : frame_(frame), origin_(origin), first_(frame.cell_of(origin)), marks_(marks) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lanes_.mask[axis] = static_cast<std::int64_t>(marks.mask(axis));
    }
  }

  // Marks the cells of each ray, from that of the origin up to, and without, that of its end.
  void mark(const std::vector<ScanRay>& rays) {
    const std::size_t count = rays.size();
    // Neighbours in the list mark the same words, and would wait for each other: each lane takes its own part of it.
    std::array<std::size_t, RayLanes::kLanes> ray{};
    std::array<std::size_t, RayLanes::kLanes> ray_end{};
    left_.fill(0);
    for (std::size_t lane = 0; lane < RayLanes::kLanes; ++lane) {
      ray[lane] = count * lane / RayLanes::kLanes;
      ray_end[lane] = count * (lane + 1) / RayLanes::kLanes;
    }
    while (true) {
      std::int64_t steps = kNoRay;
      for (std::size_t lane = 0; lane < RayLanes::kLanes; ++lane) {
        while (left_[lane] == 0) {
          if (ray[lane] == ray_end[lane]) {
            park(lane);
          } else {
            start(lane, rays[ray[lane]++]);
          }
        }
        steps = std::min(steps, left_[lane]);
      }
      if (steps == kNoRay) {
        return;
      }
      lanes_.walk(steps, marks_.passed());
      for (std::int64_t& left : left_) {
        left -= left == kNoRay ? 0 : steps;
      }
    }
  }

 private:
  static constexpr double kUnit = 0x1p60;  // the time of the end of a ray; leaves room for a step beyond it
  static constexpr std::int64_t kNever = std::int64_t{1} << 62U;
  static constexpr std::int64_t kNoRay = std::numeric_limits<std::int64_t>::max();

  void park(std::size_t lane) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lanes_.at[axis][lane] = lanes_.step[axis][lane] = lanes_.next[axis][lane] = lanes_.delta[axis][lane] = 0;
    }
    lanes_.base[lane] = static_cast<std::int64_t>(marks_.nowhere());
    left_[lane] = kNoRay;
  }

  void start(std::size_t lane, const ScanRay& ray) {
    const Eigen::Vector3d& end = ray.end;
    const VoxelIndex& last = ray.cell;
    if (!marks_.in_window(last)) {
      mark_far(end, last);
      return;
    }
    lanes_.base[lane] = 0;
    left_[lane] = start(lane, 0, origin_.x(), end.x(), first_.x, last.x) +
                  start(lane, 1, origin_.y(), end.y(), first_.y, last.y) +
                  start(lane, 2, origin_.z(), end.z(), first_.z, last.z);
  }

  // One axis of a ray; returns how many faces it crosses.
  std::int64_t start(std::size_t lane, std::size_t axis, double from, double to, std::int32_t first, std::int32_t last) {
    const std::uint64_t mask = marks_.mask(axis);
    const std::uint64_t one = std::uint64_t{1} << 2U * axis;
    const bool up = last > first;
    lanes_.at[axis][lane] = static_cast<std::int64_t>(marks_.part(axis, first));
    lanes_.step[axis][lane] = static_cast<std::int64_t>(up ? ~mask + one : ~one + 1);
    if (first == last) {
      lanes_.next[axis][lane] = kNever;
      lanes_.delta[axis][lane] = 0;
      return 0;
    }
    const double scale = kUnit / (to - from);
    const double face_m = (first + (up ? 1 : 0)) * frame_.size_m;
    lanes_.next[axis][lane] = static_cast<std::int64_t>((face_m - from) * scale);
    lanes_.delta[axis][lane] = static_cast<std::int64_t>(std::min(frame_.size_m * std::abs(scale), 2.0 * kUnit));
    return std::abs(last - first);
  }

  void mark_far(const Eigen::Vector3d& end, const VoxelIndex& last) {
    for (const VoxelIndex& cell : VoxelRay(frame_, origin_, end)) {
      if (cell != last) {
        marks_.mark_passed(cell);
      }
    }
  }

  const VoxelFrame& frame_;
  Eigen::Vector3d origin_;
  VoxelIndex first_;
  ScanMarks& marks_;
  RayLanes lanes_;
  std::array<std::int64_t, RayLanes::kLanes> left_{};  // steps to the end of the lane's ray
};

}  // namespace

void mark_rays(const ScanRays& rays, const VoxelFrame& frame, RayPolicy policy, ScanMarks& marks) {
  RayMarker marker(frame, rays.origin, marks);
  if (policy == RayPolicy::EveryReturn) {
    for (const ScanRay& ray : rays.rays) {
      if (ray.hits) {
        marks.mark_hit(ray.cell);
      }
    }
    marker.mark(rays.rays);
    return;
  }
  std::vector<ScanRay> drawn;
  for (const ScanRay& ray : rays.rays) {
    if (!ray.hits) {
      drawn.push_back(ray);
    } else if (marks.mark_hit(ray.cell)) {
      drawn.push_back({frame.centre_of(ray.cell), ray.cell, true});
    }
  }
  marker.mark(drawn);
}

}  // namespace vantage
