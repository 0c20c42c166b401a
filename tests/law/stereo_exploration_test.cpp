// SPDX-License-Identifier: MIT
// A stereo camera explores a room in which one wall has no texture. No view can measure that wall, so the frontier in
// front of it remains; a planner must give it up. (Open problem in Shade & Newman 2011, VII.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/vision/depth_camera.hpp>
#include <vantage/vision/stereo_matcher.hpp>

#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

constexpr int kWidth = 240;
constexpr int kHeight = 180;
constexpr double kBaselineM = 0.15;
constexpr double kCellM = 0.2;
constexpr std::size_t kMostViews = 150;
const Box kRoom{{0.0, 0.0, 0.0}, {3.2, 2.8, 2.2}};

StereoRig rig() {
  return {.width = kWidth, .height = kHeight, .focal_px = 140.0, .cx = 119.5, .cy = 89.5, .baseline_m = kBaselineM};
}

double noise_at(std::int64_t u, std::int64_t v, int wall) {
  std::uint64_t hash = std::uint64_t(u) * 0x9E3779B97F4A7C15U ^ std::uint64_t(v) * 0xC2B2AE3D27D4EB4FU;
  hash = (hash ^ std::uint64_t(wall)) * 0x165667B19E3779F9U;
  return double((hash >> 40U) & 0xFFU);
}

// A smooth random texture with a period of 2 cm, so that both cameras see the same pattern.
double texture_at(double u_m, double v_m, int wall) {
  constexpr double kBlotchM = 0.02;
  const double u = u_m / kBlotchM;
  const double v = v_m / kBlotchM;
  const auto i = std::int64_t(std::floor(u));
  const auto j = std::int64_t(std::floor(v));
  const double a = u - double(i);
  const double b = v - double(j);
  return (1 - b) * ((1 - a) * noise_at(i, j, wall) + a * noise_at(i + 1, j, wall)) +
         b * ((1 - a) * noise_at(i, j + 1, wall) + a * noise_at(i + 1, j + 1, wall));
}

// A room with textured walls; the wall at the largest x may have no texture.
class Room {
 public:
  explicit Room(bool one_wall_plain) : one_wall_plain_(one_wall_plain) {}

  [[nodiscard]] cv::Mat seen_from(const Pose& world_from_camera) const {
    const StereoRig camera = rig();
    cv::Mat image(kHeight, kWidth, CV_8UC1);
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const Eigen::Vector3d direction =
            world_from_camera.linear() *
            Eigen::Vector3d((column - camera.cx) / camera.focal_px, (row - camera.cy) / camera.focal_px, 1.0);
        image.at<std::uint8_t>(row, column) = brightness(world_from_camera.translation(), direction);
      }
    }
    return image;
  }

 private:
  [[nodiscard]] std::uint8_t brightness(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    double nearest = 1e9;
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
      const double wall = direction[i] > 0.0 ? kRoom.max[i] : kRoom.min[i];
      const double t = direction[i] == 0.0 ? 1e9 : (wall - from[i]) / direction[i];
      if (t < nearest) {
        nearest = t;
        axis = i;
      }
    }
    if (one_wall_plain_ && axis == 0 && direction.x() > 0.0) {
      return 230;
    }
    const Eigen::Vector3d at = from + nearest * direction;
    return std::uint8_t(
        texture_at(at[(axis + 1) % 3], at[(axis + 2) % 3], 2 * axis + (direction[axis] > 0.0 ? 1 : 0)));
  }

  bool one_wall_plain_;
};

struct Explored {
  Plan last;
  std::size_t views = 0;
  std::size_t fruitless = 0;        // views after which no cell changed its state
  std::size_t frontier_left = 0;    // cells
  std::size_t before_the_wall = 0;  // frontier cells within 1 m of the wall at the largest x
};

Explored explore(const std::string& name, bool one_wall_plain) {
  const test::TemporaryFolder folder;
  const Room room(one_wall_plain);
  const StereoMatcher matcher(rig(), {.disparities_px = 64});
  DepthCamera camera = matcher.camera(kCellM);
  camera.width = kWidth;
  camera.height = kHeight;
  const auto robot = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.15});
  const auto planner = make_planner(name, {.sensor = camera.range_sensor(), .platform = robot});
  OccupancyMap map({.resolution_m = kCellM, .region = Box{kRoom.min.array() - kCellM, kRoom.max.array() + kCellM}});
  Pose pose = pose_looking({1.1, 1.3, 1.1}, 2.0);
  map.assume_free(robot->body_box(pose));
  Explored run;
  while (run.views < kMostViews) {
    cv::imwrite(folder / "left.png", room.seen_from(pose));
    cv::imwrite(folder / "right.png", room.seen_from(pose * Eigen::Translation3d(kBaselineM, 0.0, 0.0)));
    const StereoDepth seen = matcher.match(folder / "left.png", folder / "right.png");
    ++run.views;
    run.fruitless += map.insert(depth_scan(seen.depth, camera, pose).scan).cells_changed == 0 ? 1U : 0U;
    run.last = planner->plan(map, pose);
    if (run.last.outcome != Outcome::Move) {
      break;
    }
    pose = run.last.goal.pose;
  }
  for (const VoxelIndex& cell : frontier_cells(map)) {
    ++run.frontier_left;
    run.before_the_wall += map.frame().centre_of(cell).x() > kRoom.max.x() - 1.0 ? 1U : 0U;
  }
  std::printf(
      "%-18s %-10s %zu views, %zu of them fruitless, %s: %s; %zu unobservable of %zu frontier cells, %zu at the "
      "wall\n",
      name.c_str(), one_wall_plain ? "plain wall" : "papered", run.views, run.fruitless,
      std::string(to_string(run.last.outcome)).c_str(), run.last.reason.c_str(), run.last.leftover.unobservable,
      run.frontier_left, run.before_the_wall);
  return run;
}

class StereoExploration : public testing::TestWithParam<const char*> {};

TEST_P(StereoExploration, EndsBeforeAWallThatNoViewCanMeasure) {
  const Explored plain = explore(GetParam(), true);
  const Explored papered = explore(GetParam(), false);
  EXPECT_NE(plain.last.outcome, Outcome::Move) << "it stares for ever";
  EXPECT_LT(plain.views, kMostViews);
  EXPECT_GT(plain.last.leftover.in_vain, 0U);
  EXPECT_GT(plain.before_the_wall, 0.9 * double(plain.frontier_left));
  EXPECT_GT(plain.last.leftover.in_vain, papered.last.leftover.in_vain) << "the wall is what cannot be had";
}

INSTANTIATE_TEST_SUITE_P(Every, StereoExploration,
                         testing::Values("harmonic", "nearest-frontier", "frontier-gain", "frontier-void"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

}  // namespace
}  // namespace vantage
