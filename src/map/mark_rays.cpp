// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map/mark_rays.hpp>
#include <vantage/geometry/voxel_ray.hpp>

namespace vantage {
namespace {

// VoxelRay with the time along the ray as an integer, in which ties and their order are the same but comparing and adding
// take one cycle each, and without branches: which axis steps next cannot be predicted.
class RayMarker {
 public:
  RayMarker(const VoxelFrame& frame, const Eigen::Vector3d& origin, ScanMarks& marks)
      : frame_(frame),
        origin_(origin),
        first_(frame.cell_of(origin)),
        marks_(marks),
        passed_(marks.passed()),
        along_{marks.along(0), marks.along(1), marks.along(2)} {}

  // Marks the cells from that of the origin up to, and without, `last`, the cell of `end`.
  void mark(const Eigen::Vector3d& end, const VoxelIndex& last) {
    if (marks_.in_window(last)) {
      mark_in_window(end, last);
      return;
    }
    for (const VoxelIndex& cell : VoxelRay(frame_, origin_, end)) {
      if (cell != last) {
        marks_.mark_passed(cell);
      }
    }
  }

 private:
  using Time = std::int64_t;
  static constexpr double kUnit = 0x1p60;  // the end of the ray; leaves room for a step beyond it
  static constexpr Time kNever = Time{1} << 62U;

  struct Axis {
    Time next;
    Time delta;
    std::int64_t sign;
    std::size_t at;
  };
  [[nodiscard]] Axis axis(double from, double to, std::int32_t first, std::int32_t last, std::int32_t lo) const {
    Axis a{kNever, 0, last >= first ? 1 : -1, static_cast<std::size_t>(first - lo)};
    if (first != last) {
      const double scale = kUnit / (to - from);
      const double face_m = (first + (a.sign > 0 ? 1 : 0)) * frame_.size_m;
      a.next = static_cast<Time>((face_m - from) * scale);
      a.delta = static_cast<Time>(std::min(frame_.size_m * std::abs(scale), 2.0 * kUnit));  // beyond the end is enough
    }
    return a;
  }

  void mark_in_window(const Eigen::Vector3d& end, const VoxelIndex& last) {
    const VoxelIndex lo = marks_.window().lo;
    Axis x = axis(origin_.x(), end.x(), first_.x, last.x, lo.x);
    Axis y = axis(origin_.y(), end.y(), first_.y, last.y, lo.y);
    Axis z = axis(origin_.z(), end.z(), first_.z, last.z, lo.z);
    const std::int32_t steps = std::abs(last.x - first_.x) + std::abs(last.y - first_.y) + std::abs(last.z - first_.z);
    for (std::int32_t step = 0; step < steps; ++step) {
      const std::size_t position = std::size_t{along_[0][x.at]} + along_[1][y.at] + along_[2][z.at];
      passed_[position >> 6U] |= std::uint64_t{1} << (position & 63U);
      const std::int64_t step_x = -static_cast<std::int64_t>((x.next <= y.next) & (x.next <= z.next));
      const std::int64_t step_y = ~step_x & -static_cast<std::int64_t>(y.next <= z.next);
      const std::int64_t step_z = ~step_x & ~step_y;
      x.next += x.delta & step_x;
      y.next += y.delta & step_y;
      z.next += z.delta & step_z;
      x.at += static_cast<std::size_t>(x.sign & step_x);
      y.at += static_cast<std::size_t>(y.sign & step_y);
      z.at += static_cast<std::size_t>(z.sign & step_z);
    }
  }

  const VoxelFrame& frame_;
  Eigen::Vector3d origin_;
  VoxelIndex first_;
  ScanMarks& marks_;
  std::uint64_t* passed_;
  std::array<const std::uint32_t*, 3> along_;
};

}  // namespace

void mark_rays(const ScanRays& rays, const VoxelFrame& frame, RayPolicy policy, ScanMarks& marks) {
  RayMarker marker(frame, rays.origin, marks);
  for (const ScanRay& ray : rays.rays) {
    const VoxelIndex last = frame.cell_of(ray.end);
    const bool is_new = ray.hits && marks.mark_hit(last);
    if (!ray.hits || policy == RayPolicy::EveryReturn) {
      marker.mark(ray.end, last);
    } else if (is_new) {
      marker.mark(frame.centre_of(last), last);
    }
  }
}

}  // namespace vantage
