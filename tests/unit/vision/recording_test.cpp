// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vantage/vision/read_picture.hpp>
#include <vantage/vision/recording.hpp>
#include <vector>

#include "support/depth_files.hpp"
#include "support/real_data.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::write_depth;
using test::write_text;

constexpr const char* kHere = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::vector<std::uint16_t> flat(std::uint16_t number) { return std::vector<std::uint16_t>(8 * 6, number); }

std::string opening(std::string_view format, const fs::path& folder) {
  return message_of<std::runtime_error>([&] { (void)Recording::open(format, folder); });
}

bool names(const Recording& recording, std::size_t index, const std::string& name, const std::string& reason) {
  const SkippedFrame& skipped = recording.skipped().at(index);
  return skipped.name.find(name) != std::string::npos && skipped.reason.find(reason) != std::string::npos;
}

TEST(Recording, RefusesWhatIsNoRecording) {
  const test::TemporaryFolder folder;
  EXPECT_NE(message_of<std::invalid_argument>([&] {
              (void)Recording::open("rosbag", folder / ".");
            }).find("there is no format 'rosbag'; there are: 7scenes, apc"),
            std::string::npos);
  for (const std::string_view format : Recording::formats()) {
    EXPECT_NE(opening(format, folder / "nowhere").find("nowhere: is not a folder"), std::string::npos) << format;
    EXPECT_NE(opening(format, folder / ".").find((folder / ".").string()), std::string::npos) << format;
  }
  EXPECT_THROW((void)Recording::open("tum", folder / ".", {.max_stamp_gap_s = 0.0}), std::invalid_argument);
}

TEST(SevenScenes, LeavesOutWhatIsIncompleteAndNamesIt) {
  const test::TemporaryFolder folder;
  for (const char* name : {"frame-000000", "frame-000001", "frame-000002", "frame-000003", "frame-000005"}) {
    write_depth(folder / (std::string(name) + ".depth.png"), 8, 6, flat(2000));
    write_text(folder / (std::string(name) + ".pose.txt"), kHere);
  }
  fs::remove(folder / "frame-000001.pose.txt");
  write_text(folder / "frame-000002.pose.txt", "1 0 0 0\n0 nan 0 0\n0 0 1 0\n0 0 0 1\n");
  write_text(folder / "frame-000003.pose.txt", "1 0 0 0\n0 2 0 0\n0 0 1 0\n0 0 0 1\n");
  write_text(folder / "frame-000004.pose.txt", kHere);
  const Recording recording = Recording::open("7scenes", folder / ".");
  ASSERT_EQ(recording.frames().size(), 2U);
  EXPECT_EQ(recording.frames()[1].name, "frame-000005");
  ASSERT_EQ(recording.skipped().size(), 4U);
  EXPECT_TRUE(names(recording, 0, "frame-000001", "no frame-000001.pose.txt"));
  EXPECT_TRUE(names(recording, 1, "frame-000002", "not a rigid transform"));
  EXPECT_TRUE(names(recording, 2, "frame-000003", "not a rigid transform"));
  EXPECT_TRUE(names(recording, 3, "frame-000004", "no frame-000004.depth.png"));
  EXPECT_EQ(recording.camera().width, 8U);
  EXPECT_EQ(recording.camera().fx, 585.0);
  EXPECT_EQ(recording.assumed().rfind("there is no camera-intrinsics.txt: fx = fy = 585", 0), 0U);
  EXPECT_EQ(recording.read(1).scan.report.used, 48U);

  write_text(folder / "frame-000005.pose.txt", "1 0 0 0\n0 x 0 0\n");
  const Recording less = Recording::open("7scenes", folder / ".");
  EXPECT_EQ(less.frames().size(), 1U) << "the others are not lost";
  EXPECT_TRUE(names(less, 3, "frame-000005", "not a rigid transform"));
  write_text(folder / "frame-000005.pose.txt", kHere);
  write_text(folder / "camera-intrinsics.txt", "1 2 3");
  EXPECT_NE(opening("7scenes", folder / ".").find("camera-intrinsics.txt: has 3 numbers"), std::string::npos);
  write_text(folder / "camera-intrinsics.txt", "0 0 320\n0 585 240\n0 0 1\n");
  EXPECT_NE(opening("7scenes", folder / ".").find("camera-intrinsics.txt: DepthCamera::fx is 0, must be"),
            std::string::npos);
  const Recording mended = Recording::open("7scenes", folder / ".", {.intrinsics = {{500.0, 500.0, 3.5, 2.5}}});
  EXPECT_EQ(mended.camera().fx, 500.0) << "options override what the file says";
  EXPECT_EQ(mended.assumed(), "");
}

// A damaged image is reported; the frames before and after it are not affected.
TEST(SevenScenes, ADamagedImageInTheMiddleSpoilsNoOther) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a", "b", "c", "d"}) {
    write_depth(folder / (std::string(name) + ".depth.png"), 8, 6, flat(1500));
    write_text(folder / (std::string(name) + ".pose.txt"), kHere);
  }
  write_text(folder / "a.depth.png", "not an image");
  fs::resize_file(folder / "b.depth.png", fs::file_size(folder / "b.depth.png") - 20);
  write_depth(folder / "c.depth.png", 6, 8, flat(1500));
  write_depth(folder / "e.depth.png", 8, 6, flat(1500));
  write_text(folder / "e.pose.txt", kHere);
  const Recording recording = Recording::open("7scenes", folder / ".");
  ASSERT_EQ(recording.frames().size(), 5U);
  const auto reading = [&](std::size_t frame) {
    return message_of<std::runtime_error>([&] { (void)recording.read(frame); });
  };
  // The size is that of the first readable image, which is the odd one of this recording.
  EXPECT_NE(reading(0).find("a.depth.png: is not a PNG"), std::string::npos);
  EXPECT_NE(reading(1).find("b.depth.png: is a PNG file that was cut off"), std::string::npos);
  EXPECT_EQ(reading(2), "");
  EXPECT_NE(reading(3).find("d.depth.png: is 8 x 6 pixels, the recording's first image is 6 x 8"), std::string::npos);
  EXPECT_THROW((void)recording.read(5), std::out_of_range);
}

class TumFolder : public testing::Test {
 protected:
  TumFolder() {
    write_depth(folder_ / "1.png", 8, 6, flat(5000));
    write_depth(folder_ / "2.png", 8, 6, flat(10000));
    write_text(folder_ / "depth.txt", "# depth maps\n2.000 2.png\n1.000 1.png\n3.000 3.png\n4.000 1.png\n");
    write_text(folder_ / "rgb.txt", "1.015 colour1.png\n0.99 colour0.png\n");
    write_text(folder_ / "groundtruth.txt",
               "# timestamp tx ty tz qx qy qz qw\n0.999 1 2 3 0 0 0 2\n1.5 9 9 9 0 0 0 1\n2.02 4 5 6 0 0 0.6 0.8\n"
               "3.0 0 0 0 0 0 0 1\n3.999 nan 0 0 0 0 0 1\n4.001 0 0 0 0 0 0 0\n");
  }
  test::TemporaryFolder folder_;
};

TEST_F(TumFolder, JoinsTheNearestStampsAndNamesThoseWithoutPartner) {
  const Recording recording = Recording::open("tum", folder_ / ".", {.max_stamp_gap_s = 0.0201});
  ASSERT_EQ(recording.frames().size(), 2U);
  EXPECT_EQ(recording.frames()[0].name, "1.000");
  EXPECT_EQ(recording.frames()[0].colour.filename(), "colour0.png") << "0.99 is nearer to 1 than 1.015";
  EXPECT_TRUE(recording.frames()[1].colour.empty());
  EXPECT_TRUE(recording.pose(0).translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE(recording.pose(0).linear().isIdentity(1e-12)) << "a quaternion of length 2 is normalised";
  EXPECT_EQ(recording.normalised(), 1U);
  EXPECT_TRUE(recording.pose(1).translation().isApprox(Eigen::Vector3d(4, 5, 6)));
  ASSERT_EQ(recording.skipped().size(), 4U);
  EXPECT_TRUE(names(recording, 0, "line 6 of groundtruth.txt", "not a pose"));
  EXPECT_TRUE(names(recording, 1, "line 7 of groundtruth.txt", "not a pose"));
  EXPECT_TRUE(names(recording, 2, "3.000", "there is no file"));
  EXPECT_TRUE(names(recording, 3, "4.000", "no pose within"));
  EXPECT_FLOAT_EQ(recording.read(0).depth.at(3, 3), 1.0F) << "5000 to a metre";
  EXPECT_EQ(recording.camera().fx, 525.0);
}

TEST_F(TumFolder, TakesTheIntrinsicsOfIclNuim) {
  const Recording recording =
      Recording::open("tum", folder_ / ".", {.max_range_m = 3.0, .intrinsics = {{481.2, -480.0, 3.5, 2.5}}});
  const Scan scan = recording.read(0).scan.scan;
  EXPECT_GT(scan.points.front().y(), 0.0F) << "the first row is the uppermost, and y points up";
  EXPECT_GT(recording.sensor().fy, 0.0);
  EXPECT_EQ(recording.sensor().max_range_m, 3.0);
}

TEST_F(TumFolder, NamesTheOptionAtFault) {
  const auto said = [&](const RecordingOptions& options) {
    return message_of<std::invalid_argument>([&] { (void)Recording::open("tum", folder_ / ".", options); });
  };
  EXPECT_EQ(said({}), "");
  EXPECT_EQ(said({.max_range_m = -1.0}), "RecordingOptions::max_range_m is -1, must be > 0");
  EXPECT_EQ(said({.min_range_m = std::nan("")}), "RecordingOptions::min_range_m is nan, must be >= 0");
  EXPECT_EQ(said({.max_range_m = 0.25}),
            "RecordingOptions::max_range_m is 0.25, must be > the smallest range, 0.400000");
  EXPECT_EQ(said({.min_range_m = 4.0}), "RecordingOptions::min_range_m is 4, must be < the trusted range, 4.000000");
  EXPECT_EQ(said({.intrinsics = {{0.0, 480.0, 3.5, 2.5}}}), "RecordingOptions::intrinsics is 0, must be > 0 (fx)");
  EXPECT_EQ(said({.intrinsics = {{480.0, 0.0, 3.5, 2.5}}}),
            "RecordingOptions::intrinsics is 0, must be finite and not 0 (fy)");
}

TEST_F(TumFolder, SaysWhatIsWrong) {
  EXPECT_EQ(Recording::open("tum", folder_ / ".").frames().size(), 1U) << "0.02 s by default";
  write_text(folder_ / "depth.txt", "1.0 1.png\nlater 2.png\n");
  EXPECT_NE(opening("tum", folder_ / ".").find("depth.txt: line 2 'later 2.png' must be a time stamp and a file"),
            std::string::npos);
  write_text(folder_ / "depth.txt", "7.0 1.png\n");
  EXPECT_NE(opening("tum", folder_ / ".").find("there is no frame to read in it; the first one left out is line 6"),
            std::string::npos);
  write_text(folder_ / "groundtruth.txt", "1.0 0 0 0 0 0 0\n");
  EXPECT_NE(opening("tum", folder_ / ".").find("there is no frame to read in it"), std::string::npos);
  fs::remove(folder_ / "groundtruth.txt");
  EXPECT_NE(opening("tum", folder_ / ".").find("groundtruth.txt: cannot be opened"), std::string::npos);
}

TEST(Apc, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  const std::string k = "# Depth camera intrinsic matrix\n500 0 3.5\n0 500 2.5\n0 0 1\n";
  const std::string extrinsics = std::string("# Depth-to-color camera extrinsic matrix\n") + kHere;
  const std::string pose = std::string("# Camera-to-world extrinsic matrix (camera pose) for f0\n") + kHere;
  fs::create_directories(folder / "raw");
  write_depth(folder / "raw/f0.depth.png", 8, 6, flat(0x4E20));  // 0x4E20 rotated back by 3 bits: 0x09C4 = 2500
  write_depth(folder / "raw/f1.depth.png", 8, 6, flat(0x4E20));
  write_text(folder / "cam.info.txt", k + extrinsics + pose);
  const Recording recording = Recording::open("apc", folder / ".");
  ASSERT_EQ(recording.frames().size(), 1U);
  EXPECT_TRUE(names(recording, 0, "f1", "no pose"));
  EXPECT_FLOAT_EQ(recording.read(0).depth.at(0, 0), 0.25F);
  write_text(folder / "cam.info.txt", k + pose);
  EXPECT_NE(opening("apc", folder / ".").find("'Depth-to-color camera extrinsic matrix'"), std::string::npos);
  write_text(folder / "cam.info.txt", k + "five\n");
  EXPECT_NE(opening("apc", folder / ".").find("cam.info.txt: line 5 is not a row of numbers"), std::string::npos);
}

// Median difference between the depths of two frames at the same points, metres.
double median_gap_m(const Recording& recording, std::size_t from, std::size_t to) {
  const DepthCamera& camera = recording.camera();
  const Scan scan = recording.read(from).scan.scan;
  const DepthImage target = recording.read(to).depth;
  const Pose to_from = recording.pose(to).inverse() * recording.pose(from);
  std::vector<double> gaps;
  for (const Eigen::Vector3f& point : scan.points) {
    const Eigen::Vector3d p = to_from * point.cast<double>();
    const double u = std::round(camera.fx * p.x() / p.z() + camera.cx);
    const double v = std::round(camera.fy * p.y() / p.z() + camera.cy);
    if (p.allFinite() && p.z() > 0.0 && u >= 0.0 && v >= 0.0 && u < double(camera.width) &&
        v < double(camera.height)) {
      const double gap = std::abs(p.z() - double(target.at(std::size_t(u), std::size_t(v))));
      if (gap < 0.1) {  // otherwise not measured or occluded
        gaps.push_back(gap);
      }
    }
  }
  EXPECT_GT(gaps.size(), 1000U);
  std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(gaps.size() / 2), gaps.end());
  return gaps[gaps.size() / 2];
}

TEST(RealRecordings, SevenScenesFramesAgreeWithTheirNeighbours) {
  VANTAGE_REAL_DATA(folder, "rgbd/7scenes_redkitchen_40");
  const Recording recording = Recording::open("7scenes", folder);
  ASSERT_EQ(recording.frames().size(), 40U);
  EXPECT_TRUE(recording.skipped().empty());
  const double gap_m = median_gap_m(recording, 3, 4);
  EXPECT_LT(gap_m, 0.02);
  const Picture picture = read_picture(recording.frames()[3].colour);
  EXPECT_EQ(picture.width, 640U);
}

// Pairs of random dots ten pixels apart; an invalid pair does not affect the others.
TEST(KittiStereo, LeavesOutWhatIsIncompleteAndNamesIt) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "image_0");
  fs::create_directories(folder / "image_1");
  cv::Mat dots(120, 210, CV_8UC1);
  cv::randu(dots, 0, 256);
  for (int i = 0; i < 7; ++i) {
    const std::string name = "/00000" + std::to_string(i) + ".png";
    cv::imwrite(folder / ("image_0" + name), dots.colRange(0, 200));
    cv::imwrite(folder / ("image_1" + name), i == 4 ? dots.colRange(10, 110) : dots.colRange(10, 210));
  }
  fs::remove(folder / "image_1/000001.png");
  fs::resize_file(folder / "image_1/000005.png", 5000);
  write_text(folder / "calib.txt", "P0: 200 0 100 0 0 200 60 0 0 0 1 0\nP1: 200 0 100 -20 0 200 60 0 0 0 1 0\n");
  const std::string here = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  write_text(folder / "poses.txt", here + here + "1 0 0 nan 0 1 0 0 0 0 1 0\n" + "1 0 word\n" + here + here);
  const Recording recording = Recording::open("kitti-stereo", folder / ".");
  ASSERT_EQ(recording.frames().size(), 3U);
  ASSERT_EQ(recording.skipped().size(), 4U);
  EXPECT_TRUE(names(recording, 0, "000001", "image_1/000001.png"));
  EXPECT_TRUE(names(recording, 1, "000002", "row 3 of poses.txt is not a rigid transform"));
  EXPECT_TRUE(names(recording, 2, "000003", "row 4 of poses.txt is not a rigid transform"));
  EXPECT_TRUE(names(recording, 3, "000006", "poses.txt ends after 6 poses"));
  const auto reading = [&](std::size_t frame) {
    return message_of<std::runtime_error>([&] { (void)recording.read(frame); });
  };
  EXPECT_EQ(reading(0), "");
  EXPECT_NE(reading(1).find("000004.png: is 100 x 120 pixels, the left image is 200 x 120"), std::string::npos);
  EXPECT_NE(reading(2).find("000005.png: "), std::string::npos) << reading(2);
  EXPECT_NEAR(double(recording.read(0).depth.at(120, 60)), 200.0 * 0.1 / 10.0, 0.05);
  fs::remove(folder / "calib.txt");
  EXPECT_NE(opening("kitti-stereo", folder / ".").find("calib.txt: cannot be opened"), std::string::npos);
}

// Share of the pixels with a depth, of those that both cameras see.
double measured_share(const DepthImage& depth) {
  int measured = 0;
  int pixels = 0;
  for (std::size_t v = 10; v + 10 < depth.height; ++v) {
    for (std::size_t u = 40; u + 10 < depth.width; ++u) {
      ++pixels;
      measured += std::isnan(depth.at(u, v)) ? 0 : 1;
    }
  }
  return double(measured) / double(pixels);
}

// The colour cameras of KITTI are the third and the fourth of the calibration.
TEST(KittiStereo, ColourImagesAreReadWithTheirOwnMatrices) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "image_2");
  fs::create_directories(folder / "image_3");
  cv::Mat dots(120, 220, CV_8UC1);
  cv::randu(dots, 0, 256);
  cv::imwrite(folder / "image_2/000000.png", dots.colRange(0, 200));
  cv::imwrite(folder / "image_3/000000.png", dots.colRange(20, 220));
  write_text(folder / "calib.txt",
             "P0: 200 0 100 0 0 200 60 0 0 0 1 0\nP1: 200 0 100 -20 0 200 60 0 0 0 1 0\n"
             "P2: 200 0 100 5 0 200 60 0 0 0 1 0\nP3: 200 0 100 -35 0 200 60 0 0 0 1 0\n");
  write_text(folder / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const Recording recording = Recording::open("kitti-stereo", folder / ".");
  EXPECT_NEAR(double(recording.read(0).depth.at(120, 60)), 200.0 * 0.2 / 20.0, 0.05) << "by P2 and P3";
  // The range ends before the shift of twenty pixels.
  const Recording short_range =
      Recording::open("kitti-stereo", folder / ".", {.stereo = StereoOptions{.disparities_px = 16, .window_px = 7}});
  const double all = measured_share(recording.read(0).depth);
  EXPECT_GT(all, 0.8);
  EXPECT_LT(measured_share(short_range.read(0).depth), 0.5 * all) << "some dots look alike by chance";
  EXPECT_NE(message_of<std::invalid_argument>([&] {
              (void)Recording::open("tum", folder / ".", {.stereo = StereoOptions{}});
            }).find("RecordingOptions::stereo"),
            std::string::npos);
}

// A camera that is held level in a world with another axis up, and one that looks down.
TEST(Recording, TheAxisThatIsUpInTheImagesPointsUp) {
  const test::TemporaryFolder folder;
  cv::imwrite(folder / "depth.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(5000)));
  write_text(folder / "depth.txt", "1.0 depth.png\n");
  const auto opened = [&](const std::string& quaternion, const RecordingOptions& options) {
    write_text(folder / "groundtruth.txt", "1.0 1 2 3 " + quaternion + "\n");
    return Recording::open("tum", folder / ".", options);
  };
  const auto image_up = [](const Recording& recording) -> Eigen::Vector3d {
    return -recording.pose(0).linear().col(1);
  };
  const std::string level = "0.5 -0.5 0.5 -0.5";  // -y of the images is +z of the world
  EXPECT_EQ(opened(level, {}).up(), "z");
  EXPECT_TRUE(opened(level, {}).pose(0).translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  const std::vector<std::pair<std::string, std::string>> turns{{"0 0 0 1", "-y"},
                                                               {"1 0 0 0", "y"},
                                                               {"0 0 0.70710678 0.70710678", "x"},
                                                               {"0 0 -0.70710678 0.70710678", "-x"},
                                                               {"0.70710678 0 0 0.70710678", "-z"}};
  for (const auto& [quaternion, up] : turns) {
    const Recording recording = opened(quaternion, {});
    EXPECT_EQ(recording.up(), up);
    EXPECT_EQ(recording.up_of_format(), "z");
    EXPECT_TRUE(image_up(recording).isApprox(Eigen::Vector3d::UnitZ(), 1e-6)) << up;
    EXPECT_NEAR(recording.pose(0).linear().determinant(), 1.0, 1e-9);
    EXPECT_EQ(opened(quaternion, {.up = "z"}).up(), "z") << "what is asked for is not guessed";
  }
  // Rows that count upwards.
  const Recording flipped = opened("1 0 0 0", {.intrinsics = {{60.0, -60.0, 32.0, 24.0}}});
  EXPECT_EQ(flipped.up(), "-y");
  // Half way between two axes: the format decides.
  EXPECT_EQ(opened("0 0 0.38268343 0.92387953", {}).up(), "z");
  EXPECT_NE(message_of<std::invalid_argument>([&] { (void)opened(level, {.up = "up"}); }).find("is 'up'"),
            std::string::npos);
}

// The rows of poses.txt follow the names of the images, whatever their endings.
TEST(KittiStereo, ImagesOfBothKindsShareOneOrder) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "image_0");
  fs::create_directories(folder / "image_1");
  const cv::Mat grey(60, 100, CV_8UC1, cv::Scalar(9));
  for (const char* name : {"000000.jpg", "000001.png", "000001.jpg", "000002.jpg", "000003.png"}) {
    cv::imwrite(folder / (std::string("image_0/") + name), grey);
    cv::imwrite(folder / (std::string("image_1/") + name), grey);
  }
  write_text(folder / "calib.txt", "P0: 200 0 10 0 0 200 6 0 0 0 1 0\nP1: 200 0 10 -20 0 200 6 0 0 0 1 0\n");
  std::string poses;
  for (int i = 0; i < 4; ++i) {
    poses += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
  }
  write_text(folder / "poses.txt", poses);
  const Recording recording = Recording::open("kitti-stereo", folder / ".");
  ASSERT_EQ(recording.frames().size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(recording.frames()[i].name, "00000" + std::to_string(i));
    EXPECT_NEAR(recording.pose(i).translation().norm(), double(i), 1e-9) << "the pose of row " << i;
  }
  ASSERT_EQ(recording.skipped().size(), 1U);
  EXPECT_TRUE(names(recording, 0, "000001.jpg", "there is also 000001.png"));
}

// Range scans of a plate, two of them rotated: all lie where the list says.
class StanfordFolder : public testing::Test {
 protected:
  StanfordFolder() {
    write_text(folder_ / "plate.conf",
               "camera 0 0 -1 0 0 0 1\nbmesh a.ply 0 0 0 0 0 0 1\nbmesh b.ply 0.5 0 0 0 0.7071068 0 0.7071068\n"
               "bmesh c.ply 0 0 0 0 0 0 3\nbmesh d.ply 0 0 0 0 0 0 0\nbmesh e.ply 0 0 0 0 0 0 1\n");
    for (const char* name : {"a.ply", "c.ply"}) {
      write_text(folder_ / name, plate(9));
    }
    const std::string text = plate(9);
    gzFile_s* const packed = gzopen((folder_ / "b.ply.gz").c_str(), "wb");
    EXPECT_EQ(gzwrite(packed, text.data(), unsigned(text.size())), int(text.size()));
    gzclose(packed);
  }
  static std::string plate(int told) {
    std::string text = "ply\nformat ascii 1.0\nobj_info num_cols 3\nelement vertex " + std::to_string(told) +
                       "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
                       "element range_grid 9\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < 9; ++i) {
      text += std::to_string(0.01 * (i % 3)) + " " + std::to_string(0.1 + 0.01 * (i / 3)) + " 0.02 0.5\n";
    }
    return text + "0\n1 3\n";
  }
  test::TemporaryFolder folder_;
};

TEST_F(StanfordFolder, RangeScansLieWhereTheListHasThem) {
  const Recording recording = Recording::open("stanford", folder_ / ".");
  ASSERT_EQ(recording.frames().size(), 3U);
  EXPECT_EQ(recording.normalised(), 1U);
  ASSERT_EQ(recording.skipped().size(), 2U);
  EXPECT_TRUE(names(recording, 0, "d.ply", "line 5 of plate.conf has no pose"));
  EXPECT_TRUE(names(recording, 1, "e.ply", "there is no e.ply or e.ply.gz"));
  // p_object = R(q)^T p + t, and the object's y axis points up.
  const std::vector<Eigen::Vector3d> first{{0.0, -0.02, 0.1}, {0.5 - 0.02, 0.0, 0.1}, {0.0, -0.02, 0.1}};
  for (std::size_t i = 0; i < 3; ++i) {
    const RecordedReading reading = recording.read(i);
    ASSERT_EQ(reading.scan.scan.points.size(), 9U);
    EXPECT_EQ(reading.scan.report.used, 9U);
    const Eigen::Vector3d point = recording.pose(i) * reading.scan.scan.points[0].cast<double>();
    EXPECT_LT((point - first[i]).norm(), 1e-6) << i << ": " << point.transpose();
    EXPECT_NEAR(reading.scan.scan.points[0].z(), 0.68, 1e-6) << "the scanner stands 0.7 m before the object";
    EXPECT_EQ(reading.depth.measured(), 9U);
  }
}

TEST_F(StanfordFolder, SaysWhatIsWrong) {
  const auto reading = [&] {
    return message_of<std::runtime_error>([&] { (void)Recording::open("stanford", folder_ / ".").read(0); });
  };
  write_text(folder_ / "a.ply", plate(12));
  EXPECT_NE(reading().find("a.ply: vertex 10 is not 4 numbers"), std::string::npos) << reading();
  write_text(folder_ / "a.ply", plate(9).substr(0, 250));
  EXPECT_NE(reading().find("a.ply: "), std::string::npos) << reading();
  write_text(folder_ / "a.ply", "ply\nformat binary_little_endian 1.0\n");
  EXPECT_NE(reading().find("a.ply: is no range scan"), std::string::npos) << reading();
  fs::copy_file(folder_ / "b.ply.gz", folder_ / "a.ply", fs::copy_options::overwrite_existing);
  EXPECT_EQ(reading(), "") << "packed under any name";
  fs::resize_file(folder_ / "a.ply", fs::file_size(folder_ / "a.ply") - 12);
  EXPECT_NE(reading().find("a.ply: is cut off or damaged"), std::string::npos) << reading();
  fs::remove(folder_ / "plate.conf");
  EXPECT_NE(opening("stanford", folder_ / ".").find("there is no list *.conf"), std::string::npos);
}

// Reads both file types, each with the camera of its pixels; the wrong camera doubles the median gap of decoded
// frames.
TEST(RealRecordings, ApcFramesAgreeWithTheirNeighbours) {
  VANTAGE_REAL_DATA(folder, "rgbd/apc_shelf_bin_15");
  const Recording decoded = Recording::open("apc", folder);
  ASSERT_EQ(decoded.frames().size(), 15U);
  EXPECT_NEAR(double(decoded.read(7).depth.measured()) / (640.0 * 480.0), 0.27, 0.1);
  EXPECT_LT(median_gap_m(decoded, 6, 7), 0.005);

  const test::TemporaryFolder driver;  // raw output of the driver, without decoded images
  fs::copy(folder / "cam.info.txt", driver / "cam.info.txt");
  fs::copy(folder / "raw", driver / "raw");
  const Recording raw = Recording::open("apc", driver / ".");
  ASSERT_EQ(raw.frames().size(), 15U);
  EXPECT_FALSE(raw.camera().posed_from_depth.isApprox(Pose::Identity()));
  EXPECT_LT(median_gap_m(raw, 6, 7), 0.006);
}

}  // namespace
}  // namespace vantage
