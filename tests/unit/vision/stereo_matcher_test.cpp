// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/stereo_matcher.hpp>
#include <vector>

#include "support/depth_files.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

using test::message_of;

StereoRig rig() { return {.focal_px = 200.0, .cx = 100.0, .cy = 60.0, .baseline_m = 0.1}; }

// A pair of random-dot images with offset `disparity(column)`; `plain` columns have no texture.
class DotPair {
 public:
  DotPair(const std::function<int(int)>& disparity, const std::function<bool(int)>& plain, int rows_down = 0) {
    std::mt19937 engine(17);
    cv::Mat left(120, 200, CV_8UC1);
    for (int row = 0; row < left.rows; ++row) {
      for (int column = 0; column < left.cols; ++column) {
        left.at<std::uint8_t>(row, column) = plain(column) ? 128 : static_cast<std::uint8_t>(engine() % 256);
      }
    }
    cv::Mat right(left.size(), CV_8UC1);
    for (int row = 0; row < left.rows; ++row) {
      for (int column = 0; column < left.cols; ++column) {
        right.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(engine() % 256);
      }
      for (int column = 0; column < left.cols; ++column) {
        const int to = column - disparity(column);
        const int from_row = row - rows_down;
        if (to >= 0 && from_row >= 0) {
          right.at<std::uint8_t>(row, to) = left.at<std::uint8_t>(from_row, column);
        }
      }
    }
    cv::imwrite(this->left(), left);
    cv::imwrite(this->right(), right);
  }
  [[nodiscard]] std::string left() const { return folder_ / "left.png"; }
  [[nodiscard]] std::string right() const { return folder_ / "right.png"; }

 private:
  test::TemporaryFolder folder_;
};

TEST(StereoMatcher, FindsKnownDisparitiesByEitherMethod) {
  const DotPair pair([](int column) { return column < 110 ? 10 : 20; }, [](int) { return false; });
  for (const StereoMethod method : {StereoMethod::SemiGlobal, StereoMethod::Block}) {
    const StereoMatcher matcher(rig(), {.method = method, .disparities_px = 32, .window_px = 7});
    const StereoDepth seen = matcher.match(pair.left(), pair.right());
    const StereoReport& report = seen.report;
    EXPECT_EQ(report.matched + report.unmatched + report.speckle + report.textureless, 200U * 120U);
    EXPECT_EQ(report.matched, seen.depth.measured());
    EXPECT_GT(report.matched, 200U * 120U * 6U / 10U);
    std::size_t wrong = 0;
    for (std::size_t row = 0; row < 120; ++row) {
      for (std::size_t column = 0; column < 200; ++column) {
        const float z = seen.depth.at(column, row);
        const float expected = column < 110 ? 2.0F : 1.0F;
        wrong += std::isfinite(z) && std::abs(z - expected) > 0.05F ? 1U : 0U;
        EXPECT_TRUE(!std::isfinite(z) || column >= 10) << "what is left of the right image has no match";
      }
    }
    EXPECT_LT(wrong, report.matched / 20U) << "only where the two depths meet";
  }
}

TEST(StereoMatcher, AMatchAtTheEndOfTheRangeIsNone) {
  // One half of the image is as near as the range reaches, or nearer; it must not be free in front of that.
  for (const int near_px : {31, 45}) {
    const DotPair pair([&](int column) { return column < 120 ? 10 : near_px; }, [](int) { return false; });
    for (const StereoMethod method : {StereoMethod::SemiGlobal, StereoMethod::Block}) {
      const StereoMatcher matcher(rig(), {.method = method, .disparities_px = 32, .window_px = 7});
      const StereoDepth seen = matcher.match(pair.left(), pair.right());
      for (const float disparity_px : seen.disparity_px) {
        EXPECT_FALSE(disparity_px > 30.9F || disparity_px < 0.1F) << near_px;
      }
      EXPECT_GT(seen.report.matched, 200U * 120U * 3U / 10U) << "the far half";
    }
  }
}

TEST(StereoMatcher, TheRangeFollowsFromTheRig) {
  EXPECT_EQ(StereoMatcher(rig()).options().disparities_px, 64) << "f / 4 = 50 px, in whole 16";
  StereoRig shifted = rig();
  shifted.offset_px = 20.0;
  EXPECT_EQ(StereoMatcher(shifted).options().disparities_px, 32) << "the offset is part of f b / z";
  shifted.focal_px = 1e5;
  EXPECT_EQ(StereoMatcher(shifted).options().disparities_px, 1024);
  EXPECT_EQ(StereoMatcher(rig(), {.disparities_px = 128}).options().disparities_px, 128);
  // A surface 4 baselines away is matched, whatever the number was before.
  const DotPair pair([](int) { return 50; }, [](int) { return false; });
  const StereoDepth seen = StereoMatcher(rig()).match(pair.left(), pair.right());
  EXPECT_NEAR(seen.depth.at(150, 60), 0.4F, 0.01F);
}

TEST(StereoMatcher, WhatIsPlainHasNoDepthAndFreesNothing) {
  const DotPair pair([](int) { return 10; }, [](int column) { return column >= 80 && column < 140; });
  const StereoMatcher matcher(rig(), {.disparities_px = 32});
  const StereoDepth seen = matcher.match(pair.left(), pair.right());
  for (std::size_t row = 0; row < 120; ++row) {
    for (std::size_t column = 84; column < 136; ++column) {
      EXPECT_TRUE(std::isnan(seen.depth.at(column, row))) << column << ' ' << row;
    }
  }
  DepthCamera camera = matcher.camera(0.1, 5.0);
  camera.width = 200;
  camera.height = 120;
  OccupancyMap map({.resolution_m = 0.1});
  map.insert(depth_scan(seen.depth, camera, Pose::Identity()).scan);
  EXPECT_EQ(map.at(map.frame().cell_of({0.1, 0.0, 1.5})), Occupancy::Unknown) << "column 113 looks there";
  EXPECT_EQ(map.at(map.frame().cell_of({-0.45, 0.05, 1.5})), Occupancy::Free) << "column 40 looks there";
}

TEST(StereoMatcher, RefusesAPairThatDoesNotFit) {
  const auto ten = [](int) { return 10; };
  const auto never = [](int) { return false; };
  const DotPair pair(ten, never);
  const StereoMatcher matcher(rig(), {.disparities_px = 32});
  const auto said = [&](const std::string& left, const std::string& right, const StereoMatcher& by) {
    return message_of<std::runtime_error>([&] { (void)by.match(left, right); });
  };
  EXPECT_EQ(said(pair.left(), pair.right(), matcher), "");
  EXPECT_NE(said(pair.left(), "none.png", matcher).find("none.png: cannot be opened"), std::string::npos);
  const test::TemporaryFolder folder;
  cv::imwrite(folder / "small.png", cv::Mat(60, 100, CV_8UC1, cv::Scalar(0)));
  EXPECT_NE(said(pair.left(), folder / "small.png", matcher)
                .find("small.png: is 100 x 60 pixels, the left image is 200 x 120 pixels"),
            std::string::npos);
  StereoRig sized = rig();
  sized.width = 640;
  sized.height = 480;
  EXPECT_NE(said(pair.left(), pair.right(), StereoMatcher(sized)).find("the calibration is for 640 x 480"),
            std::string::npos);
  sized = rig();
  sized.width = 200;  // and a height that is not known
  EXPECT_EQ(said(pair.left(), pair.right(), StereoMatcher(sized, {.disparities_px = 32})), "");
  sized.width = 0;
  sized.height = 480;
  EXPECT_NE(said(pair.left(), pair.right(), StereoMatcher(sized)).find("the calibration is for any x 480"),
            std::string::npos);
  const DotPair crooked(ten, never, 5);
  EXPECT_NE(said(crooked.left(), crooked.right(), matcher).find("is not rectified: what it shows lies 5 rows off"),
            std::string::npos);
}

TEST(StereoMatcher, NamesTheFieldAtFault) {
  const auto said = [](const StereoRig& r, const StereoOptions& options) {
    return message_of<std::invalid_argument>([&] { const StereoMatcher matcher(r, options); });
  };
  EXPECT_NE(said({}, {}).find("StereoRig::focal_px is 0"), std::string::npos);
  EXPECT_NE(said({.focal_px = 1.0}, {}).find("StereoRig::baseline_m is 0"), std::string::npos);
  const std::vector<std::pair<StereoOptions, const char*>> faults{
      {{.disparities_px = 20}, "disparities_px is 20"},
      {{.window_px = 4}, "window_px is 4"},
      {{.uniqueness_percent = 101}, "uniqueness_percent"},
      {{.speckle_pixels = -1}, "speckle_pixels is -1"},
      {{.speckle_step_px = -1.0}, "speckle_step_px is -1"},
      {{.least_texture = -1.0}, "least_texture is -1"},
      {{.sigma_d_px = 0.0}, "sigma_d_px is 0"},
      {{.least_disparity_px = 2000}, "least_disparity_px"}};
  for (const auto& [options, words] : faults) {
    EXPECT_NE(said(rig(), options).find(words), std::string::npos) << words;
  }
}

TEST(StereoRig, UncertaintyEndsTheRange) {
  const StereoMatcher matcher(rig(), {.sigma_d_px = 0.5});
  EXPECT_NEAR(matcher.rig().depth_m(10.0), 2.0, 1e-12);
  EXPECT_NEAR(matcher.rig().sigma_m(2.0, 0.5), 0.1, 1e-12) << "z^2 sigma_d / (f b)";
  // The same by a difference of depths.
  EXPECT_NEAR((matcher.rig().depth_m(9.999) - matcher.rig().depth_m(10.001)) / 0.002, 0.2, 1e-6);
  EXPECT_NEAR(matcher.camera(0.1).trusted_range_m(), 2.0, 1e-12) << "where sigma is a cell";
}

TEST(StereoRig, CalibrationsAreRead) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "kitti.txt",
                   "P0: 700 0 600 0 0 700 180 0 0 0 1 0\nP1: 700 0 600 -350 0 700 180 0 0 0 1 0\n");
  const StereoRig kitti = read_kitti_calibration(folder / "kitti.txt");
  EXPECT_DOUBLE_EQ(kitti.baseline_m, 0.5);
  EXPECT_DOUBLE_EQ(kitti.cy, 180.0);
  test::write_text(folder / "colour.txt",
                   "P0: 700 0 600 0 0 700 180 0 0 0 1 0\nP1: 700 0 600 -350 0 700 180 0 0 0 1 0\n"
                   "P2: 710 0 610 42 0 710 170 0 0 0 1 0\nP3: 710 0 610 -313 0 710 170 0 0 0 1 0\n"
                   "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  const StereoRig colour = read_kitti_calibration(folder / "colour.txt", 2);
  EXPECT_DOUBLE_EQ(colour.focal_px, 710.0);
  EXPECT_DOUBLE_EQ(colour.baseline_m, 0.5);
  EXPECT_DOUBLE_EQ(colour.cy, 170.0);
  test::write_text(folder / "middlebury.txt",
                   "cam0=[3979.911 0 1244.772; 0 3979.911 1019.507; 0 0 1]\ncam1=[3979.911 0 1369.115; 0 3979.911 "
                   "1019.507; 0 0 1]\ndoffs=124.343\nbaseline=193.001\nwidth=2964\nheight=2000\nndisp=280\n");
  const StereoRig middlebury = read_middlebury_calibration(folder / "middlebury.txt");
  EXPECT_DOUBLE_EQ(middlebury.baseline_m, 0.193001);
  EXPECT_DOUBLE_EQ(middlebury.offset_px, 124.343);
  EXPECT_EQ(middlebury.width, 2964U);

  // Two parallel cameras without distortion: rectification changes nothing.
  cv::FileStorage out(folder / "rig.yml", cv::FileStorage::WRITE);
  const cv::Mat k = (cv::Mat_<double>(3, 3) << 200, 0, 100, 0, 200, 60, 0, 0, 1);
  out << "M1" << k << "D1" << cv::Mat::zeros(1, 5, CV_64F) << "M2" << k << "D2" << cv::Mat::zeros(1, 5, CV_64F) << "R"
      << cv::Mat::eye(3, 3, CV_64F) << "T" << (cv::Mat_<double>(3, 1) << -100, 0, 0);
  out.release();
  const StereoRig same = read_opencv_calibration(folder / "rig.yml", folder / "rig.yml", 200, 120, 0.001);
  EXPECT_NEAR(same.focal_px, 200.0, 1.0);
  EXPECT_NEAR(same.baseline_m, 0.1, 1e-9);
  EXPECT_NEAR(same.offset_px, 0.0, 1e-9);
  const DotPair pair([](int) { return 10; }, [](int) { return false; });
  const StereoDepth seen = StereoMatcher(same, {.disparities_px = 32}).match(pair.left(), pair.right());
  EXPECT_GT(seen.report.matched, 200U * 120U / 2U);
  EXPECT_NEAR(seen.depth.at(120, 60), 2.0F, 0.02F);
}

TEST(StereoRig, LensesThatOpencvDoesNotKnowAreRefused) {
  std::size_t refused = 0;
  for (std::size_t count = 0; count < 16; ++count) {
    StereoRig of_count = rig();
    of_count.rectification = Rectification{};
    of_count.rectification->right.distortion.assign(count, 0.0);
    const std::string said = message_of<std::invalid_argument>([&] { of_count.validate(); });
    refused += said.empty() ? 0U : 1U;
    EXPECT_TRUE(said.empty() || said == "count of Rectification::right.distortion is " + std::to_string(count) +
                                            ", must be 0, 4, 5, 8, 12 or 14")
        << said;
  }
  EXPECT_EQ(refused, 10U);
  StereoRig not_finite = rig();
  not_finite.rectification = Rectification{};
  not_finite.rectification->left.distortion = {0.0, 0.0, std::nan(""), 0.0};
  EXPECT_THROW(not_finite.validate(), std::invalid_argument);
  not_finite.rectification->left.distortion.clear();
  EXPECT_NO_THROW(not_finite.validate());
  not_finite.rectification->left.k(0, 2) = INFINITY;
  EXPECT_THROW(not_finite.validate(), std::invalid_argument);
}

TEST(StereoRig, BadCalibrationsAreRefusedByName) {
  const test::TemporaryFolder folder;
  const auto said = [&](const std::string& text, const std::function<StereoRig(const std::string&)>& read) {
    test::write_text(folder / "calib.txt", text);
    return message_of<std::runtime_error>([&] { (void)read(folder / "calib.txt"); });
  };
  const auto kitti = [](const std::string& file) { return read_kitti_calibration(file); };
  const auto middlebury = [](const std::string& file) { return read_middlebury_calibration(file); };
  const auto opencv = [](const std::string& file) { return read_opencv_calibration(file, file, 640, 480); };
  EXPECT_NE(said("P0: 1 2 3\n", kitti).find("calib.txt: line 1 is not a projection matrix"), std::string::npos);
  EXPECT_NE(said("700 0 600 0 0 700 180 0 0 0 1 0\n", kitti).find("has no projection matrices P0 and P1"),
            std::string::npos);
  EXPECT_NE(said("700 0 600 0 0 700 180 0 0 0 1 0\n700 0 600 9 0 700 180 0 0 0 1 0\n", kitti)
                .find("calib.txt: StereoRig::baseline_m is -0.0128"),
            std::string::npos)
      << "left and right the wrong way round";
  EXPECT_NE(said("width=9\nheight=nine\n", middlebury).find("line 2 is not key=value"), std::string::npos);
  EXPECT_NE(said("width=9\nheight=9\n", middlebury).find("there is no 'focal_px'"), std::string::npos);
  for (const char* count : {"-1", "1e30", "nan", "inf", "2.5"}) {
    EXPECT_NE(said(std::string("width=") + count + "\nheight=9\n", middlebury).find("'width' is no number of pixels"),
              std::string::npos)
        << count;
  }
  EXPECT_NE(said("%YAML:1.0\n---\nM1: 3\n", opencv).find("calib.txt: "), std::string::npos);
  EXPECT_NE(said("{[:", opencv).find("calib.txt: "), std::string::npos);
  const auto matrix = [](const char* name, int rows, int columns, const char* numbers) {
    return std::string(name) + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
           "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ " + numbers + " ]\n";
  };
  const char* const k = "200, 0, 100, 0, 200, 60, 0, 0, 1";
  const std::string pair = "%YAML:1.0\n---\n" + matrix("M1", 3, 3, k) + matrix("M2", 3, 3, k) +
                           matrix("R", 3, 3, "1, 0, 0, 0, 1, 0, 0, 0, 1") + matrix("T", 3, 1, "-0.1, 0, 0");
  const auto with = [&](int columns, const char* numbers) {
    return said(pair + matrix("D1", 1, columns, numbers) + matrix("D2", 1, columns, numbers), opencv);
  };
  EXPECT_EQ(with(5, "0, 0, 0, 0, 0"), "");
  EXPECT_NE(with(6, "0, 0, 0, 0, 0, 0").find("calib.txt: OpenCV cannot rectify this pair"), std::string::npos)
      << "there is no lens with six numbers";
  EXPECT_NE(message_of<std::runtime_error>([&] { (void)read_kitti_calibration(folder / "no.txt"); }).find("no.txt"),
            std::string::npos);
}

}  // namespace
}  // namespace vantage
