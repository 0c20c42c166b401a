// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/trajectory.hpp>
#include <vantage/robot/turning.hpp>
#include <vantage/view/target_view.hpp>
#include <vector>

#include <vantage/geometry/impl/pose_distance.hpp>
#include <vantage/planner/impl/glances.hpp>

namespace vantage {
namespace {

using detail::FrontierSite;
using detail::TourViews;

const Eigen::Vector3d kAtRest = Eigen::Vector3d::Zero();
const MotionModel kMotion{.max_speed_m_s = 1.0,
                          .max_acceleration_m_s2 = 3.0,
                          .max_yaw_rate_rad_s = 0.5 * std::numbers::pi,
                          .scan_rate_hz = 15.0};

// A corridor of 8 m with a wall on either side, and niches in the walls that are not known.
class InACorridor : public ::testing::Test {
 protected:
  explicit InACorridor(const MotionModel& motion = kMotion)
      : map_({.resolution_m = 0.2}),
        situation_({.sensor = RangeSensor::pinhole(40, 30, std::numbers::pi / 2.0, std::numbers::pi / 3.0, 0.0, 5.0),
                    .platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.1, .yaw_only = true}),
                    .motion = motion}) {}

  void make(unsigned seed) {
    std::mt19937 engine(seed);
    map_ = OccupancyMap({.resolution_m = 0.2});
    for_each_cell({{-5, -6, -3}, {35, 7, 4}}, [&](const VoxelIndex& cell) {
      const bool is_wall = cell.y < -4 || cell.y > 4;
      map_.set(cell, is_wall ? Occupancy::Occupied : Occupancy::Free);
    });
    for (int niche = 0; niche < 8; ++niche) {
      const auto x = static_cast<std::int32_t>(engine() % 30);
      const std::int32_t y = engine() % 2 == 0 ? 5 : -6;
      const auto size = static_cast<std::int32_t>(1 + engine() % 4);
      for_each_cell({{x, y, -1}, {x + size, y + 2, 1}},
                    [&](const VoxelIndex& cell) { map_.set(cell, Occupancy::Unknown); });
    }
    situation_.sync(map_, at({0.1, 0.1, 0.1}));
    sites_ = detail::frontier_sites(situation_.survey().targets, {8, 8, 8});
  }
  // Looks along the corridor.
  [[nodiscard]] static Pose at(const Eigen::Vector3d& position) { return pose_looking(position, 0.0); }
  [[nodiscard]] std::vector<Pose> way_through() const {
    return {at({0.1, 0.1, 0.1}), at({3.1, -0.3, 0.1}), at({6.1, 0.3, 0.1})};
  }
  [[nodiscard]] std::vector<Pose> glancing(const std::vector<Pose>& path) {
    std::uint64_t operations = 0;
    const TourViews parts(situation_, sites_, operations);
    return detail::with_glances(path, parts, situation_, kAtRest, operations);
  }

  OccupancyMap map_;
  Situation situation_;
  std::vector<FrontierSite> sites_;
};

class SlowlyInACorridor : public InACorridor {
 protected:
  static MotionModel slow() {
    MotionModel motion = kMotion;
    motion.max_yaw_rate_rad_s = 0.001;
    return motion;
  }
  SlowlyInACorridor() : InACorridor(slow()) {}
};

Trajectory in_time(const std::vector<Pose>& path) {
  const auto anywhere = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return true; };
  return Trajectory::through({path.front().translation(), kAtRest}, path, kMotion, anywhere).value();
}

// Scans of a robot that turns, as soon as it has passed a pose of its path, to the next one.
std::vector<Pose> scans_along(const std::vector<Pose>& path) {
  constexpr int kStepsOfAScan = 4;
  const double step_s = 1.0 / kMotion.scan_rate_hz / kStepsOfAScan;
  const Trajectory way = in_time(path);
  Turning turning(path.front().linear());
  std::vector<Pose> scans{path.front()};
  std::size_t next = 1;
  for (int step = 1; step * step_s < way.duration_s() + step_s; ++step) {
    while (next + 1 < path.size() && way.passes_at_s()[next] < (step - 1) * step_s) {
      ++next;
    }
    turning.advance(path[next].linear(), step_s, kMotion);
    if (step % kStepsOfAScan == 0) {
      scans.push_back(Pose::Identity());
      scans.back().translation() = way.at(step * step_s).position_m;
      scans.back().linear() = turning.orientation();
    }
  }
  return scans;
}

TEST_F(InACorridor, AGlanceCostsNoTimeAndSeesMore) {
  std::size_t glances = 0;
  std::size_t more = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    make(seed);
    const std::vector<Pose> path = way_through();
    const std::vector<Pose> glancing_path = glancing(path);
    // The corners are the same, the poses between them stand on the legs.
    std::size_t corner = 0;
    std::vector<Pose> aside;
    for (const Pose& pose : glancing_path) {
      if ((pose.translation() - path[corner].translation()).norm() < 1e-9) {
        ++corner;
        continue;
      }
      const Eigen::Vector3d from = path[corner - 1].translation();
      const Eigen::Vector3d leg = path[corner].translation() - from;
      EXPECT_LT((pose.translation() - from).cross(leg).norm(), 1e-9);
      aside.push_back(pose);
    }
    glances += aside.size();
    ASSERT_EQ(corner, path.size());
    EXPECT_TRUE(glancing_path.front().isApprox(path.front()));
    EXPECT_TRUE(glancing_path.back().isApprox(path.back()));
    for (std::size_t i = 1; i < glancing_path.size(); ++i) {
      EXPECT_TRUE(situation_.platform().admits_motion(map_, glancing_path[i - 1], glancing_path[i]));
    }
    // Each glance is reached, to within the turn of one scan, and the robot comes no later.
    const std::vector<Pose> scans = scans_along(glancing_path);
    for (const Pose& pose : aside) {
      const bool is_reached = std::any_of(scans.begin(), scans.end(), [&](const Pose& scan) {
        return (scan.translation() - pose.translation()).norm() < kMotion.max_speed_m_s / kMotion.scan_rate_hz &&
               detail::angle_rad(scan, pose) < kMotion.max_yaw_rate_rad_s / kMotion.scan_rate_hz;
      });
      EXPECT_TRUE(is_reached);
    }
    EXPECT_LT(in_time(glancing_path).duration_s(), 1.02 * in_time(path).duration_s());
    const auto seen_on = [&](const std::vector<Pose>& poses) {
      std::uint64_t operations = 0;
      std::set<VoxelIndex> seen;
      for (const Pose& pose : poses) {
        for (const VoxelIndex& cell : targets_seen_from(situation_.surveyed(), pose, operations).unknown) {
          seen.insert(cell);
        }
      }
      return seen.size();
    };
    const std::size_t seen = seen_on(scans);
    const std::size_t seen_without = seen_on(scans_along(path));
    EXPECT_GE(seen, seen_without);
    more += seen > seen_without ? 1U : 0U;
  }
  EXPECT_GT(glances, 20U);
  EXPECT_GT(more, 10U);
}

TEST_F(SlowlyInACorridor, ThereIsNoTimeForAGlance) {
  make(1);
  const std::vector<Pose> path = way_through();
  const std::vector<Pose> same = glancing(path);
  ASSERT_EQ(same.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_TRUE(same[i].isApprox(path[i]));
  }
}

}  // namespace
}  // namespace vantage
