// SPDX-License-Identifier: MIT
// Registration of recorded scans, from initial poses that are off by a known amount.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/vision/recording.hpp>
#include <vantage/vision/registration.hpp>
#include <vector>

#include "support/bunny_scans.hpp"
#include "support/depth_files.hpp"
#include "support/real_data.hpp"

namespace vantage {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// A pose rotated about `middle` by `turned_rad` and moved by `moved_m` metres, in random directions.
Pose off_by(double moved_m, double turned_rad, const Eigen::Vector3d& middle, std::mt19937& engine) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Eigen::Vector3d(normal(engine), normal(engine), normal(engine)).normalized().eval();
  };
  const Eigen::Vector3d move = moved_m * direction();
  return Eigen::Translation3d(middle + move) * Eigen::AngleAxisd(turned_rad, direction()) *
         Eigen::Translation3d(-middle);
}

// A corner of three walls with a step, which fixes all degrees of freedom.
std::vector<Eigen::Vector3f> corner() {
  std::vector<Eigen::Vector3f> points;
  for (float a = 0.0F; a < 1.0F; a += 0.02F) {
    for (float b = 0.0F; b < 1.0F; b += 0.02F) {
      points.emplace_back(a, b, b > 0.5F && a > 0.3F ? 0.2F : 0.0F);
      points.emplace_back(a, 0.0F, b);
      points.emplace_back(0.0F, a, b);
    }
  }
  return points;
}

TEST(Registration, FindsAKnownPose) {
  std::mt19937 engine(2);
  const std::vector<Eigen::Vector3f> points = corner();
  const RegistrationOptions options{.point_spacing_m = 0.03, .gap_m = 0.04};
  int converged = 0;
  for (int run = 0; run < 5; ++run) {
    const Pose guess = off_by(0.05, 3.0 * kDegree, {0.3, 0.3, 0.3}, engine);
    const Registration found = register_points(points, points, guess, options);
    EXPECT_LT((found.world_from_sensor.translation()).norm(), 0.005) << found.reason;
    converged += found.converged ? 1 : 0;
    EXPECT_GT(found.overlap, 0.9);
    EXPECT_LT(found.rms_m, 0.005);
    EXPECT_TRUE(found.covariance.isApprox(found.covariance.transpose(), 1e-6));
  }
  EXPECT_EQ(converged, 5);
}

TEST(Registration, APlaneAloneSlidesAndTheCovarianceSaysSo) {
  std::mt19937 engine(4);
  std::normal_distribution<float> noise(0.0F, 0.002F);
  std::vector<Eigen::Vector3f> plane[2];
  for (std::vector<Eigen::Vector3f>& points : plane) {
    for (float a = 0.0F; a < 1.0F; a += 0.02F) {
      for (float b = 0.0F; b < 1.0F; b += 0.02F) {
        points.emplace_back(a, b, 1.0F + noise(engine));
      }
    }
  }
  const Registration found = register_points(plane[0], plane[1], Pose::Identity(), {.point_spacing_m = 0.01});
  EXPECT_GT(found.rms_m, 0.0005);
  EXPECT_GT(found.covariance(3, 3), 20.0 * found.covariance(5, 5)) << "along x much worse than along z";
}

TEST(Registration, FailsHonestly) {
  const std::vector<Eigen::Vector3f> points = corner();
  Pose far = Pose::Identity();
  far.translation() = Eigen::Vector3d(20.0, 0.0, 0.0);
  const Registration apart = register_points(points, points, far, {});
  EXPECT_FALSE(apart.converged);
  EXPECT_TRUE(apart.world_from_sensor.isApprox(far)) << "the guess comes back";
  EXPECT_FALSE(apart.reason.empty());
  const Registration none = register_points({}, points, Pose::Identity(), {});
  EXPECT_FALSE(none.converged);
  EXPECT_NE(none.reason.find("too few points: 0 in the scan"), std::string::npos);
  const std::vector<Eigen::Vector3f> nothing(1000, Eigen::Vector3f::Constant(std::nanf("")));
  EXPECT_FALSE(register_points(nothing, points, Pose::Identity(), {}).converged);
}

TEST(Registration, NamesTheOptionAtFault) {
  const auto said = [](const RegistrationOptions& options) {
    return test::message_of<std::invalid_argument>([&] { (void)register_points({}, {}, Pose::Identity(), options); });
  };
  const std::vector<std::pair<RegistrationOptions, const char*>> faults{
      {{.point_spacing_m = 0.0}, "point_spacing_m is 0"},
      {{.gap_m = 0.0}, "gap_m is 0"},
      {{.iterations = 0}, "iterations is 0"},
      {{.levels = 9}, "levels is 9"},
      {{.least_overlap = 2.0}, "least_overlap is 2"},
      {{.most_moved_m = 0.0}, "most_moved_m is 0"},
      {{.most_turned_rad = 0.0}, "most_turned_rad is 0"}};
  for (const auto& [options, words] : faults) {
    EXPECT_NE(said(options).find(words), std::string::npos) << words;
  }
  Pose bent = Pose::Identity();
  bent.linear() *= 2.0;
  EXPECT_THROW((void)register_points({}, {}, bent, {}), std::invalid_argument);
}

struct Tally {
  int right = 0;
  int believed = 0;
  int believed_wrong = 0;
  int all = 0;

  void count(bool is_believed, bool is_right) {
    right += is_right ? 1 : 0;
    believed += is_believed ? 1 : 0;
    believed_wrong += is_believed && !is_right ? 1 : 0;
    ++all;
  }
  void print(const char* what, double moved_m, double turned_rad) const {
    std::printf("%s, guess off by %.0f mm and %.0f deg: %d of %d right, %d believed, %d of these wrong\n", what,
                1000.0 * moved_m, turned_rad / kDegree, right, all, believed, believed_wrong);
  }
};

constexpr std::pair<double, double> kOff[] = {{0.02, 1.0 * kDegree}, {0.05, 3.0 * kDegree}, {0.1, 5.0 * kDegree}};

// Each scan of the bunny against the nine others. The bunny is 15 cm long, so an error of 10 cm is large.
TEST(RealRegistration, BunnyScans) {
  VANTAGE_REAL_DATA(folder, "object_scans/stanford_bunny_range");
  const std::vector<test::BunnyScan> scans = test::bunny_scans(folder);
  ASSERT_EQ(scans.size(), 10U);
  const RegistrationOptions options{.point_spacing_m = 0.002, .gap_m = 0.003, .least_overlap = 0.7};
  std::mt19937 engine(1);
  for (const auto& [moved_m, turned_rad] : kOff) {
    Tally tally;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      std::vector<Eigen::Vector3f> others;
      for (std::size_t j = 0; j < scans.size(); ++j) {
        for (std::size_t k = 0; j != i && k < scans[j].points.size(); k += 4) {
          others.push_back((scans[j].world_from_scan * scans[j].points[k].cast<double>()).cast<float>());
        }
      }
      const Eigen::Vector3d middle(-0.02, 0.1, 0.0);
      const Pose guess = off_by(moved_m, turned_rad, middle, engine) * scans[i].world_from_scan;
      const Registration found = register_points(scans[i].points, others, guess, options);
      const Pose left_over = found.world_from_sensor * scans[i].world_from_scan.inverse();
      const bool right = (left_over * middle - middle).norm() < 0.005 &&
                         Eigen::AngleAxisd(left_over.linear()).angle() < 0.2 * kDegree;
      tally.count(found.converged, right);
    }
    tally.print("bunny", moved_m, turned_rad);
    EXPECT_GE(tally.right, moved_m < 0.03 ? 10 : moved_m < 0.06 ? 7 : 2);
  }
}

// Median depth difference between the points of a scan at `pose` and the image of another frame, metres.
double depth_gap_m(const Scan& scan, const Pose& pose, const Recording& recording, std::size_t other) {
  const DepthCamera& camera = recording.camera();
  const DepthImage image = recording.read(other).depth;
  const Pose other_from_scan = recording.pose(other).inverse() * pose;
  std::vector<double> gaps;
  for (std::size_t k = 0; k < scan.points.size(); k += 7) {
    const Eigen::Vector3d p = other_from_scan * scan.points[k].cast<double>();
    const double u = std::round(camera.fx * p.x() / p.z() + camera.cx);
    const double v = std::round(camera.fy * p.y() / p.z() + camera.cy);
    if (p.allFinite() && p.z() > 0.0 && u >= 0.0 && v >= 0.0 && u < double(camera.width) &&
        v < double(camera.height)) {
      const double gap = std::abs(p.z() - double(image.at(std::size_t(u), std::size_t(v))));
      if (gap < 0.1) {  // otherwise not measured or occluded
        gaps.push_back(gap);
      }
    }
  }
  std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(gaps.size() / 2), gaps.end());
  return gaps.at(gaps.size() / 2);
}

// Frames of the kitchen one second apart (hand-held). A result is correct if the depth images agree as well as with
// the recorded pose, or better than 9.7 mm, the overall accuracy of the recorded poses.
TEST(RealRegistration, SevenScenesNeighbours) {
  VANTAGE_REAL_DATA(folder, "rgbd/7scenes_redkitchen_40");
  const Recording recording = Recording::open("7scenes", folder);
  const RegistrationOptions options{.point_spacing_m = 0.04, .gap_m = 0.04, .least_overlap = 0.5};
  std::mt19937 engine(1);
  for (const auto& [moved_m, turned_rad] : kOff) {
    Tally tally;
    for (std::size_t i = 1; i < recording.frames().size(); i += 3) {
      const std::vector<Scan> before{recording.read(i - 1).scan.scan};
      Scan scan = recording.read(i).scan.scan;
      const Pose given = scan.world_from_sensor;
      scan.world_from_sensor = off_by(moved_m, turned_rad, given.translation(), engine) * given;
      const Registration found = register_scan(scan, before, options);
      const double by_given_m = depth_gap_m(scan, given, recording, i - 1);
      const double by_found_m = depth_gap_m(scan, found.world_from_sensor, recording, i - 1);
      tally.count(found.converged, by_found_m <= std::max(0.0097, by_given_m));
    }
    tally.print("kitchen", moved_m, turned_rad);
    EXPECT_GE(tally.right, moved_m < 0.06 ? tally.all * 8 / 10 : tally.all / 2);
  }
}

}  // namespace
}  // namespace vantage
