// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/depth_camera.hpp>
#include <vector>

#include "support/depth_files.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

DepthCamera small_camera() {
  return {.width = 64, .height = 48, .fx = 60.0, .fy = 58.0, .cx = 30.5, .cy = 25.0, .max_range_m = 4.0};
}

DepthImage image_of(const DepthCamera& camera, const std::function<double(std::size_t, std::size_t)>& z_m) {
  DepthImage depth{camera.width, camera.height, {}};
  for (std::size_t row = 0; row < camera.height; ++row) {
    for (std::size_t column = 0; column < camera.width; ++column) {
      depth.z_m.push_back(static_cast<float>(z_m(column, row)));
    }
  }
  return depth;
}

TEST(DepthCamera, EveryPixelIsCountedOnceAndProjectsBackToItself) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> metre(0.1, 6.0);
  std::size_t points = 0;
  for (int run = 0; run < 20; ++run) {
    DepthCamera camera = small_camera();
    camera.fy = run % 2 == 0 ? 58.0 : -58.0;
    camera.min_range_m = 0.5;
    camera.edge_share = run % 3 == 0 ? 0.0 : 0.5;
    const DepthImage depth = image_of(camera, [&](std::size_t, std::size_t) {
      const double z = metre(engine);
      return z < 1.0 && z > 0.7 ? std::nan("") : z;
    });
    const DepthScan result = depth_scan(depth, camera, Pose::Identity());
    const DepthReport& report = result.report;
    EXPECT_EQ(report.used + report.not_measured + report.too_near + report.flying, 64U * 48U);
    EXPECT_EQ(report.not_measured, 64U * 48U - depth.measured());
    ASSERT_TRUE(result.scan.organised());
    std::size_t used = 0;
    for (std::size_t pixel = 0; pixel < result.scan.points.size(); ++pixel) {
      const Eigen::Vector3d p = result.scan.points[pixel].cast<double>();
      if (p.allFinite()) {
        EXPECT_NEAR(p.x() / p.z() * camera.fx + camera.cx, static_cast<double>(pixel % 64), 1e-4);
        EXPECT_NEAR(p.y() / p.z() * camera.fy + camera.cy, static_cast<double>(pixel / 64), 1e-4);
        EXPECT_EQ(result.scan.points[pixel].z(), depth.z_m[pixel]);
        ++used;
      }
    }
    EXPECT_EQ(used, report.used);
    points += used;
  }
  EXPECT_GT(points, 10000U);
}

// ICL-NUIM stores a camera with negative fy, i.e. an image upside down: the world and the rays are the same.
TEST(DepthCamera, NegativeFyIsTheImageUpsideDown) {
  DepthCamera camera = small_camera();
  camera.fy = -58.0;
  DepthCamera upright = small_camera();
  upright.cy = 47.0 - camera.cy;
  const auto z_m = [](std::size_t column, std::size_t row) {
    return 1.0 + 0.01 * double(column) + 0.02 * double(row);
  };
  const Scan scan = depth_scan(image_of(camera, z_m), camera, Pose::Identity()).scan;
  const Scan flipped = depth_scan(image_of(upright, [&](std::size_t c, std::size_t r) { return z_m(c, 47 - r); }),
                                  upright, Pose::Identity())
                           .scan;
  for (std::size_t row = 0; row < 48; ++row) {
    for (std::size_t column = 0; column < 64; ++column) {
      EXPECT_LT((scan.points[row * 64 + column] - flipped.points[(47 - row) * 64 + column]).norm(), 1e-6F);
    }
  }
  const RangeSensor sensor = camera.range_sensor();
  sensor.validate();
  EXPECT_LT((sensor.direction(5, 7) - scan.points[(47 - 7) * 64 + 5].cast<double>().normalized()).norm(), 1e-6);
}

TEST(DepthCamera, DropsWhatHangsBetweenAnEdgeAndItsBackgroundAndNothingOfPlanes) {
  const DepthCamera camera = small_camera();
  const DepthReport step =
      depth_scan(image_of(camera, [](std::size_t c, std::size_t) { return c < 20    ? 1.0
                                                                          : c == 20 ? 1.6
                                                                                    : 2.5; }),
                 camera, Pose::Identity())
          .report;
  EXPECT_EQ(step.flying, 48U) << "one column hangs in the air";
  const DepthReport crumb =
      depth_scan(image_of(camera, [](std::size_t c, std::size_t r) { return c == 9 && r == 9 ? 1.0 : 2.0; }), camera,
                 Pose::Identity())
          .report;
  EXPECT_EQ(crumb.flying, 1U) << "a pixel without support";
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> tilt(-0.8, 0.8);
  for (int run = 0; run < 50; ++run) {  // planes tilted by up to 30 degrees, with pixels of one degree
    const double a = tilt(engine);
    const double b = tilt(engine);
    const DepthReport plane = depth_scan(image_of(camera,
                                                  [&](std::size_t c, std::size_t r) {
                                                    const double x = (double(c) - camera.cx) / camera.fx;
                                                    const double y = (double(r) - camera.cy) / camera.fy;
                                                    return 2.0 / (1.0 + 0.5 * a * x + 0.5 * b * y);
                                                  }),
                                         camera, Pose::Identity())
                                  .report;
    EXPECT_EQ(plane.flying, 0U) << a << ' ' << b;
    EXPECT_EQ(plane.used, 64U * 48U);
  }
}

TEST(DepthCamera, WhatIsNotMeasuredFreesNothing) {
  const DepthCamera camera = small_camera();
  const DepthImage depth = image_of(camera, [](std::size_t c, std::size_t) { return c < 32 ? 2.0 : kNothing; });
  OccupancyMap map({.resolution_m = 0.05});
  const ScanReport report = map.insert(depth_scan(depth, camera, Pose::Identity()).scan);
  EXPECT_EQ(report.not_finite, 32U * 48U);
  std::size_t known = 0;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy) {
    // The last measured ray is inclined by 0.5 / 60 to the right; a cell that it touches may extend one edge further.
    const Eigen::Vector3d centre = map.frame().centre_of(cell);
    EXPECT_LT(centre.x(), centre.z() * 0.5 / 60.0 + 0.05);
    ++known;
  });
  EXPECT_GT(known, 1000U);
}

TEST(DepthCamera, UncertainReturnsClearAndDoNotOccupy) {
  DepthCamera camera = small_camera();
  camera.noise = {.constant_m = 0.001, .linear = 0.002, .quadratic_per_m = 0.01};
  camera.max_sigma_m = 0.03;
  EXPECT_NEAR(camera.noise.sigma_m(camera.trusted_range_m()), 0.03, 1e-12);
  EXPECT_EQ(DepthNoise{}.range_for(0.1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(DepthNoise{.constant_m = 0.2}.range_for(0.1), 0.0);
  EXPECT_NEAR((DepthNoise{.constant_m = 0.1, .linear = 0.05}.range_for(0.2)), 2.0, 1e-12);
  const DepthImage depth = image_of(camera, [](std::size_t, std::size_t) { return 3.0; });
  OccupancyMap map;
  map.insert(depth_scan(depth, camera, Pose::Identity()).scan);
  EXPECT_EQ(map.counts().occupied, 0U);
  EXPECT_GT(map.counts().free, 0U);
  EXPECT_EQ(camera.range_sensor().max_range_m, camera.trusted_range_m());
}

TEST(DepthCamera, ExtrinsicsMoveTheScan) {
  DepthCamera camera = small_camera();
  camera.posed_from_depth = pose_looking({0.1, 0.2, 0.3}, 0.4, 0.1);
  const Pose world_from_posed = pose_looking({1.0, 2.0, 3.0}, -0.7);
  const DepthImage depth = image_of(camera, [](std::size_t, std::size_t) { return 1.0; });
  EXPECT_TRUE(depth_scan(depth, camera, world_from_posed)
                  .scan.world_from_sensor.isApprox(world_from_posed * camera.posed_from_depth));
}

TEST(DepthCamera, NamesTheFieldAtFault) {
  const auto said = [](const std::function<void(DepthCamera&)>& spoil) {
    DepthCamera camera = small_camera();
    spoil(camera);
    return test::message_of<std::invalid_argument>([&] { camera.validate(); });
  };
  const std::vector<std::pair<const char*, std::function<void(DepthCamera&)>>> faults{
      {"DepthCamera::width is 0", [](auto& c) { c.width = 0; }},
      {"DepthCamera::height is 0", [](auto& c) { c.height = 0; }},
      {"DepthCamera::fx is -1", [](auto& c) { c.fx = -1.0; }},
      {"DepthCamera::fy is 0", [](auto& c) { c.fy = 0.0; }},
      {"DepthCamera::cx is nan", [](auto& c) { c.cx = std::nan(""); }},
      {"DepthCamera::cy is inf", [](auto& c) { c.cy = HUGE_VAL; }},
      {"DepthCamera::min_range_m is -1", [](auto& c) { c.min_range_m = -1.0; }},
      {"DepthCamera::max_range_m is 0", [](auto& c) { c.max_range_m = 0.0; }},
      {"DepthNoise::constant_m is -1", [](auto& c) { c.noise.constant_m = -1.0; }},
      {"DepthNoise::linear is -1", [](auto& c) { c.noise.linear = -1.0; }},
      {"DepthNoise::quadratic_per_m is -1", [](auto& c) { c.noise.quadratic_per_m = -1.0; }},
      {"DepthCamera::max_sigma_m is 0", [](auto& c) { c.max_sigma_m = 0.0; }},
      {"DepthCamera::edge_share is 1", [](auto& c) { c.edge_share = 1.0; }},
      {"DepthCamera::min_support is 9", [](auto& c) { c.min_support = 9; }},
      {"DepthCamera::posed_from_depth", [](auto& c) { c.posed_from_depth.linear() *= 2.0; }}};
  for (const auto& [words, spoil] : faults) {
    EXPECT_NE(said(spoil).find(words), std::string::npos) << words << " | " << said(spoil);
  }
  EXPECT_EQ(said([](auto&) {}), "");
  EXPECT_NE(test::message_of<std::invalid_argument>([] {
              (void)depth_scan(DepthImage{3, 2, std::vector<float>(6)}, small_camera(), Pose::Identity());
            }).find("3 x 2 pixels, the camera's are 64 x 48"),
            std::string::npos);
}

TEST(DepthImage, ComesBackFromItsFile) {
  const test::TemporaryFolder folder;
  test::write_depth(folder / "depth.png", 3, 2, {0, 1, 1000, 65534, 65535, 0x2001});
  const DepthImage depth = read_depth_png(folder / "depth.png");
  ASSERT_EQ(depth.width, 3U);
  ASSERT_EQ(depth.height, 2U);
  EXPECT_EQ(depth.measured(), 4U);
  EXPECT_TRUE(std::isnan(depth.at(0, 0)) && std::isnan(depth.at(1, 1)));
  EXPECT_FLOAT_EQ(depth.at(2, 0), 1.0F);
  EXPECT_FLOAT_EQ(read_depth_png(folder / "depth.png", {.units_per_m = 5000.0}).at(2, 0), 0.2F);
  // 0x2001 rotated back by 13 bits: 0x0009.
  EXPECT_FLOAT_EQ(read_depth_png(folder / "depth.png", {.rotated_bits = 13}).at(2, 1), 0.009F);
}

TEST(DepthImage, SaysWhatIsWrongWithAFile) {
  const test::TemporaryFolder folder;
  std::vector<std::uint16_t> numbers(64 * 48);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = static_cast<std::uint16_t>(i * 7919);
  }
  test::write_depth(folder / "good.png", 64, 48, numbers);
  const std::string good = test::bytes_in(folder / "good.png");
  const auto said = [&](const std::string& bytes) {
    test::write_text(folder / "bad.png", bytes);
    return test::message_of<std::runtime_error>([&] { (void)read_depth_png(folder / "bad.png"); });
  };
  EXPECT_NE(said("").find("bad.png: is empty"), std::string::npos);
  EXPECT_NE(said("P5 3 3").find("bad.png: is not a PNG file"), std::string::npos);
  cv::imwrite(folder / "eight.png", cv::Mat(4, 4, CV_8UC1, cv::Scalar(9)));
  EXPECT_NE(said(test::bytes_in(folder / "eight.png")).find("is a PNG file of 8 bits"), std::string::npos);
  cv::imwrite(folder / "colour.png", cv::Mat(4, 4, CV_16UC3, cv::Scalar(9, 9, 9)));
  EXPECT_NE(said(test::bytes_in(folder / "colour.png")).find("in colour"), std::string::npos);
  EXPECT_NE(test::message_of<std::runtime_error>([&] { (void)read_depth_png(folder / "none.png"); }).find("none.png"),
            std::string::npos);
  EXPECT_THROW((void)read_depth_png(folder / "good.png", {.units_per_m = 0.0}), std::invalid_argument);
  EXPECT_THROW((void)read_depth_png(folder / "good.png", {.rotated_bits = 16}), std::invalid_argument);
  EXPECT_EQ(said(good), "");
  std::size_t refused = 0;
  std::mt19937 engine(11);
  for (int run = 0; run < 300; ++run) {  // truncated anywhere, or with any byte changed
    std::string bytes = good;
    const std::size_t at = engine() % bytes.size();
    if (run % 2 == 0) {
      bytes.resize(at);
    } else {
      bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1U << (engine() % 8U)));
    }
    const std::string words = said(bytes);
    EXPECT_NE(words.find("bad.png: is "), std::string::npos) << "byte " << at << " of " << good.size();
    refused += words.empty() ? 0U : 1U;
  }
  EXPECT_EQ(refused, 300U);
}

}  // namespace
}  // namespace vantage
