// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vantage/robot/grid_path.hpp>
#include <vantage/robot/wrapped_platform.hpp>
#include <vector>

#include <vantage/robot/impl/swept_sphere.hpp>

namespace vantage::testing {

/// The other end of a rod that stands out from the sensor, against its optical axis.
[[nodiscard]] inline Eigen::Vector3d rod_end(const Pose& pose, double rod_m) {
  return pose.translation() - rod_m * optical_axis(pose);
}

/// The poses of a turn on the spot, in steps of a tenth.
template <class Visit>
void for_each_turn(const Pose& from, const Pose& to, Visit&& visit) {
  const Eigen::Quaterniond first(from.linear());
  const Eigen::Quaterniond last(to.linear());
  for (int tenth = 0; tenth <= 10; ++tenth) {
    Pose pose = from;
    pose.linear() = first.slerp(0.1 * tenth, last).normalized().toRotationMatrix();
    visit(pose);
  }
}

/// A platform with a rod as thick as its sphere, or its disc in a layer of cells: which cells it needs depends on its
/// orientation. It turns on the spot before it moves.
class RodBody final : public WrappedPlatform {
 public:
  RodBody(std::shared_ptr<const Platform> carries, double radius_m, double rod_m, bool flat)
      : WrappedPlatform(std::move(carries)), radius_m_(radius_m), rod_m_(rod_m), flat_(flat) {}

  [[nodiscard]] bool admits(const OccupancyMap& map, const Pose& pose) const override {
    return wrapped().admits(map, pose) &&
           has_room(map, pose, [&](const VoxelIndex& cell) { return map.is_clear(cell); });
  }
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override {
    const Eigen::Vector3d at = map.frame().centre_of(cell);
    return wrapped().admits_cell(map, cell) &&
           std::any_of(kAllNeighbours.begin(), kAllNeighbours.end(), [&](const VoxelIndex& step) {
             return (can_tilt() || step.z == 0) && admits(map, facing(at, Eigen::Vector3d(step.x, step.y, step.z)));
           });
  }
  [[nodiscard]] double reach_m() const override { return rod_m_ + std::max(radius_m_, wrapped().reach_m()); }
  [[nodiscard]] bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const override {
    const VoxelFrame& frame = map.frame();
    const auto clear = [&](const VoxelIndex& cell) {
      return map.is_clear(cell) ||
             detail::distance_to_segment(frame.box_of(cell), from.translation(), rod_end(from, rod_m_)) <
                 detail::touching_distance_m(frame, radius_m_);
    };
    bool fits = wrapped().admits_motion(map, from, to);
    for_each_turn(from, to, [&](const Pose& pose) { fits = fits && has_room(map, pose, clear); });
    const Eigen::Vector3d way = to.translation() - from.translation();
    const auto steps = static_cast<int>(std::ceil(way.norm() / (0.25 * frame.size_m)));
    for (int step = 1; fits && step <= steps; ++step) {
      Pose pose = to;
      pose.translation() = from.translation() + way * step / steps;
      fits = has_room(map, pose, clear);
    }
    return fits;
  }
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                      const Pose& to) const override {
    return grid_path(map, *this, from, to);
  }
  [[nodiscard]] Box body_box(const Pose& pose) const override {
    Box box = wrapped().body_box(pose);
    const Eigen::Vector3d along = rod_end(pose, rod_m_) - pose.translation();
    return {box.min + along.cwiseMin(0.0), box.max + along.cwiseMax(0.0)};
  }

 private:
  // Whether all cells are clear that the body touches.
  template <class Clear>
  [[nodiscard]] bool has_room(const OccupancyMap& map, const Pose& pose, Clear&& clear) const {
    const Eigen::Vector3d end = rod_end(pose, rod_m_);
    if (!map.frame().addressable(pose.translation()) || !map.frame().addressable(end)) {
      return false;
    }
    const std::int32_t layer = map.frame().cell_of(pose.translation()).z;
    return detail::swept_sphere_is_clear(map.frame(), pose.translation(), end, radius_m_, clear,
                                         flat_ ? detail::Layers{layer, layer + 1} : detail::Layers{});
  }

  double radius_m_;
  double rod_m_;
  bool flat_;
};

}  // namespace vantage::testing
