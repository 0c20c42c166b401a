// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vantage/planner/exploration_planner.hpp>
#include <vector>

#include "contract/changing_world.hpp"
#include "contract/host.hpp"
#include "contract/scene.hpp"

#include <vantage/geometry/impl/pose_distance.hpp>

namespace vantage::testing {

/// The pose `way_m` along a path.
[[nodiscard]] inline Pose along(const std::vector<Pose>& path, double way_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step_m = (path[i].translation() - path[i - 1].translation()).norm();
    if (way_m < step_m) {
      Pose pose = path[i];
      pose.translation() =
          path[i - 1].translation() + way_m / step_m * (path[i].translation() - path[i - 1].translation());
      return pose;
    }
    way_m -= step_m;
  }
  return path.back();
}

/// Where a host stops on the path of a plan.
struct Stop {
  double way_m = 0.0;  // along the path
  Pose pose = Pose::Identity();
  bool aborts = false;
};

/// How a host departs from what a planner takes for granted: where it starts, is, stops and is carried to.
class HostErrors {
 public:
  HostErrors(Host host, const Scene& scene) : host_(host), scene_(scene), engine_(scene.seed) {}

  /// Where the host starts.
  [[nodiscard]] Eigen::Vector3d start(const ChangingWorld& world) const {
    const double cell = scene_.cell_m;
    const Eigen::Vector3d start = world.frame.centre_of(world.start);
    if (host_ == Host::OffCentre) {
      return start + cell * Eigen::Vector3d(0.31, -0.22, scene_.is_plane() ? 0.0 : 0.13);
    }
    const double corner = cell * (1.0 + scene_.body_cells + 1e-3);
    return host_ == Host::InACorner ? Eigen::Vector3d(corner, corner, scene_.is_plane() ? start.z() : corner) : start;
  }
  /// The true pose when the robot believes that it is at `believed`.
  [[nodiscard]] Pose truly_at(const Pose& believed) {
    if (host_ != Host::Inexact) {
      return believed;
    }
    const Eigen::Vector3d off(draw(-1, 1), draw(-1, 1), scene_.is_plane() ? 0.0 : draw(-1, 1));
    Pose pose = believed;
    pose.linear() =
        Eigen::AngleAxisd(draw(-0.5, 0.5) * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()) * believed.linear();
    pose.translation() += 0.01 * off.normalized();
    return pose;
  }
  /// How far distant surfaces may be mapped beside their true place, metres: the host is off by half a degree.
  [[nodiscard]] double surface_m(const RangeSensor& sensor) const {
    return host_ == Host::Inexact ? 0.01 + 0.01 * sensor.max_range_m : 1e-6;
  }
  /// Where the host stops that follows this plan.
  [[nodiscard]] Stop stop_of(const Plan& plan) {
    const double whole_m = detail::length_m(plan.path);
    if ((host_ == Host::AbortsSilently || host_ == Host::AbortsAndReports) && engine_() % 3 == 0) {
      return {0.5 * whole_m, along(plan.path, 0.5 * whole_m), true};
    }
    if (host_ == Host::PlansOnItsWay && whole_m > 3.0 * scene_.cell_m) {
      return {3.0 * scene_.cell_m, along(plan.path, 3.0 * scene_.cell_m)};
    }
    Stop stop{whole_m, plan.goal.pose};
    if (host_ == Host::StopsShort) {
      stop.way_m = std::max(0.0, whole_m - draw(0.0, 0.3));
      const double off_rad = draw(-15.0, 15.0) * std::numbers::pi / 180.0;
      stop.pose.translation() = along(plan.path, stop.way_m).translation();
      stop.pose.linear() = Eigen::AngleAxisd(off_rad, Eigen::Vector3d::UnitZ()) * stop.pose.linear();
    }
    return stop;
  }
  /// A random cell of the world, to carry the robot there.
  [[nodiscard]] VoxelIndex anywhere(const ChangingWorld& world) {
    const VoxelIndex extent = world.solid.box().extent();
    return {static_cast<std::int32_t>(draw(1.0, extent.x - 1.0)),
            static_cast<std::int32_t>(draw(1.0, extent.y - 1.0)),
            scene_.is_plane() ? world.start.z : static_cast<std::int32_t>(draw(2.0, 5.0))};
  }

 private:
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }

  Host host_;
  const Scene& scene_;
  std::mt19937 engine_;
};

}  // namespace vantage::testing
