// SPDX-License-Identifier: MIT
// Stereo on recorded images, compared with their ground truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/recording.hpp>
#include <vantage/vision/stereo_matcher.hpp>
#include <vector>

#include "support/real_data.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

// Reads a grey .pfm image, rows from the top.
std::vector<float> read_pfm(const std::filesystem::path& file, std::size_t& width, std::size_t& height) {
  std::ifstream in(file, std::ios::binary);
  std::string kind;
  double scale = 0.0;
  in >> kind >> width >> height >> scale;
  in.get();
  EXPECT_EQ(kind, "Pf");
  EXPECT_LT(scale, 0.0) << "little-endian";
  std::vector<float> values(width * height);
  for (std::size_t row = height; row-- > 0;) {
    in.read(reinterpret_cast<char*>(values.data() + row * width), std::streamsize(width * sizeof(float)));
  }
  EXPECT_TRUE(in.good());
  return values;
}

double median_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values.at(values.size() / 2);
}

StereoDepth seen_with(StereoMethod method, int disparities_px, const StereoRig& rig,
                      const std::filesystem::path& folder) {
  const int window_px = method == StereoMethod::Block ? 15 : 5;
  const StereoMatcher matcher(rig, {.method = method, .disparities_px = disparities_px, .window_px = window_px});
  return matcher.match(folder / "motorcycle_left.png", folder / "motorcycle_right.png");
}

TEST(RealStereo, MotorcycleAgainstTheTruth) {
  VANTAGE_REAL_DATA(folder, "stereo/middlebury2014_motorcycle");
  const StereoRig motorcycle = read_middlebury_calibration(folder / "calib.txt");
  std::size_t width = 0;
  std::size_t height = 0;
  const std::vector<float> truth = read_pfm(folder / "motorcycle_disp.pfm", width, height);
  ASSERT_EQ(width, motorcycle.width);
  for (const StereoMethod method : {StereoMethod::SemiGlobal, StereoMethod::Block}) {
    const bool block = method == StereoMethod::Block;
    const StereoDepth seen = seen_with(method, 80, motorcycle, folder);
    std::size_t known = 0;
    std::size_t bad = 0;
    std::vector<double> error_m;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      known += std::isfinite(truth[i]) ? 1U : 0U;
      if (std::isfinite(truth[i]) && std::isfinite(seen.disparity_px[i])) {
        bad += std::abs(seen.disparity_px[i] - truth[i]) > 2.0F ? 1U : 0U;
        error_m.push_back(std::abs(double(seen.depth.z_m[i]) - motorcycle.depth_m(double(truth[i]))));
      }
    }
    ASSERT_GT(error_m.size(), 100'000U);
    const double bad_share = double(bad) / double(error_m.size());
    const double density = double(error_m.size()) / double(known);
    const double median_m = median_of(error_m);
    std::printf("%s: bad-2.0 %.2f %%, median depth error %.1f mm, density %.1f %%\n", block ? "block" : "semi-global",
                100.0 * bad_share, 1000.0 * median_m, 100.0 * density);
    EXPECT_LT(bad_share, 0.08);
    EXPECT_LT(median_m, 0.02);
    EXPECT_GT(density, 0.6);
  }
}

// A surface nearer than the range of disparities must not be taken for a further one: the way to that would be free.
TEST(RealStereo, WhatIsNearerThanTheRangeHasNoDepth) {
  VANTAGE_REAL_DATA(folder, "stereo/middlebury2014_motorcycle");
  const StereoRig motorcycle = read_middlebury_calibration(folder / "calib.txt");
  std::size_t width = 0;
  std::size_t height = 0;
  const std::vector<float> truth = read_pfm(folder / "motorcycle_disp.pfm", width, height);
  for (const StereoMethod method : {StereoMethod::SemiGlobal, StereoMethod::Block}) {
    const bool block = method == StereoMethod::Block;
    const StereoDepth seen = seen_with(method, 32, motorcycle, folder);
    std::size_t near = 0;
    std::size_t taken_for_far = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const bool beyond = std::isfinite(truth[i]) && truth[i] > 33.0F;
      near += beyond ? 1U : 0U;
      taken_for_far += beyond && std::isfinite(seen.disparity_px[i]) ? 1U : 0U;
    }
    ASSERT_GT(near, 50'000U);
    const double share = double(taken_for_far) / double(near);
    std::printf("%s: %.2f %% of what is nearer has a depth\n", block ? "block" : "semi-global", 100.0 * share);
    EXPECT_LT(share, 0.01);
  }
}

// A chessboard with squares of 25 mm in front of two cameras with distortion and a slight rotation. Calibrated from
// its own corners, rectified and matched, the corners must be 25 mm apart.
TEST(RealStereo, AChessboardKeepsItsSizeThroughRectification) {
  VANTAGE_REAL_DATA(folder, "stereo/opencv_chessboard_rig");
  const cv::Size board(9, 6);
  constexpr float kSquareM = 0.025F;
  std::vector<cv::Point3f> flat;
  for (int row = 0; row < board.height; ++row) {
    for (int column = 0; column < board.width; ++column) {
      flat.emplace_back(kSquareM * float(column), kSquareM * float(row), 0.0F);
    }
  }
  std::vector<std::vector<cv::Point2f>> left;
  std::vector<std::vector<cv::Point2f>> right;
  std::vector<std::string> numbers;
  for (const char* number : {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"}) {
    std::vector<cv::Point2f> corners[2];
    bool found = true;
    for (int side = 0; side < 2; ++side) {
      const auto file = folder / ((side == 0 ? "left" : "right") + std::string(number) + ".jpg");
      const cv::Mat image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
      found = found && cv::findChessboardCorners(image, board, corners[side]);
    }
    if (found) {
      left.push_back(corners[0]);
      right.push_back(corners[1]);
      numbers.emplace_back(number);
    }
  }
  ASSERT_GE(numbers.size(), 10U);
  cv::FileStorage lenses((folder / "intrinsics.yml").string(), cv::FileStorage::READ);
  cv::Mat m1, d1, m2, d2, r, t, essential, fundamental;
  lenses["M1"] >> m1;
  lenses["D1"] >> d1;
  lenses["M2"] >> m2;
  lenses["D2"] >> d2;
  cv::stereoCalibrate(std::vector<std::vector<cv::Point3f>>(left.size(), flat), left, right, m1, d1, m2, d2,
                      cv::Size(640, 480), r, t, essential, fundamental, cv::CALIB_FIX_INTRINSIC);
  const test::TemporaryFolder own;
  cv::FileStorage placement(own / "extrinsics.yml", cv::FileStorage::WRITE);
  placement << "R" << r << "T" << t;
  placement.release();

  const StereoRig rig = read_opencv_calibration(folder / "intrinsics.yml", own / "extrinsics.yml", 640, 480);
  EXPECT_NEAR(rig.baseline_m, cv::norm(t), 1e-6);
  const StereoMatcher matcher(rig, {.disparities_px = 160, .window_px = 7});
  cv::Mat r1, r2, p1, p2, q;
  cv::stereoRectify(m1, d1, m2, d2, cv::Size(640, 480), r, t, r1, r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY, 0.0,
                    cv::Size(640, 480));
  std::vector<double> apart_m;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const StereoDepth seen =
        matcher.match(folder / ("left" + numbers[i] + ".jpg"), folder / ("right" + numbers[i] + ".jpg"));
    std::vector<cv::Point2f> corners;
    cv::undistortPoints(left[i], corners, m1, d1, r1, p1);
    const auto point = [&](const cv::Point2f& pixel) -> Eigen::Vector3d {
      const auto u = std::size_t(std::clamp(std::lround(pixel.x), 0L, 639L));
      const auto v = std::size_t(std::clamp(std::lround(pixel.y), 0L, 479L));
      const double z = double(seen.depth.at(u, v));
      return {(double(pixel.x) - rig.cx) / rig.focal_px * z, (double(pixel.y) - rig.cy) / rig.focal_px * z, z};
    };
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
      const double distance_m = (point(corners[k]) - point(corners[k + 1])).norm();
      if (k % std::size_t(board.width) + 1 < std::size_t(board.width) && std::isfinite(distance_m)) {
        apart_m.push_back(distance_m);
      }
    }
  }
  ASSERT_GT(apart_m.size(), 100U);
  const double median_m = median_of(apart_m);
  std::printf("chessboard: %zu distances of 25 mm, median %.2f mm\n", apart_m.size(), 1000.0 * median_m);
  EXPECT_NEAR(median_m, 0.025, 0.001);
}

// The share of hit cells of one pair that are free cells of the previous pair. Noise alone causes some: at a share x
// of the range, the standard deviation of a depth is x^2 cells, so two depths contradict each other by more than a
// cell with probability Q(1 / (sqrt(2) x^2)): 24 % at the end of the range, 2 % half-way. Surfaces spread over the
// outer half give 15 %; wrong matches, poses or calibration give more.
TEST(RealStereo, KittiPairsContradictEachOtherSeldom) {
  VANTAGE_REAL_DATA(folder, "stereo/kitti_odometry_seq1_30");
  const OccupancyMapOptions options{.resolution_m = 0.2};
  const Recording recording = Recording::open("kitti-stereo", folder, {.cell_m = options.resolution_m});
  ASSERT_EQ(recording.frames().size(), 30U);
  OccupancyMap all(options);
  OccupancyMap before(options);
  std::size_t hits = 0;
  std::size_t contradicted = 0;
  for (std::size_t i = 0; i < recording.frames().size(); ++i) {
    const Scan scan = recording.read(i).scan.scan;
    OccupancyMap now(options);
    now.insert(scan);
    if (i > 0) {
      now.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
        hits += state == Occupancy::Occupied ? 1U : 0U;
        contradicted += state == Occupancy::Occupied && before.at(cell) == Occupancy::Free ? 1U : 0U;
      });
    }
    all.insert(scan);
    before = std::move(now);
  }
  const double share = double(contradicted) / double(hits);
  const OccupancyMap::Counts counts = all.counts();
  std::printf(
      "30 pairs: %zu of %zu surface cells were free in the pair before, %.1f %%; map: %zu free, %zu occupied\n",
      contradicted, hits, 100.0 * share, counts.free, counts.occupied);
  EXPECT_GT(hits, 50'000U);
  EXPECT_GT(counts.occupied, 5'000U);
  EXPECT_LT(share, 0.15);
}

}  // namespace
}  // namespace vantage
