// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vantage/raytrace/range_sensor.hpp>

namespace vantage {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::string complaint(const RangeSensor& sensor) {
  try {
    sensor.validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RangeSensor, PresetsAreWhatTheirNamesSay) {
  for (const std::string_view name : RangeSensor::preset_names()) {
    EXPECT_EQ(complaint(RangeSensor::preset(name)), "") << name;
  }
  const RangeSensor kinect = RangeSensor::preset("kinect");
  EXPECT_NEAR(kinect.horizontal_angle_rad(), 57 * kDegree, 1e-9);
  EXPECT_NEAR(kinect.vertical_angle_rad(), 43 * kDegree, 1e-9);
  EXPECT_EQ(kinect.width, 640U);
  EXPECT_EQ(kinect.max_range_m, 4.0);
  const RangeSensor stereo = RangeSensor::preset("stereo");
  EXPECT_NEAR(stereo.horizontal_angle_rad(), 65 * kDegree, 1e-9);
  EXPECT_NEAR(stereo.fx, stereo.fy, 1e-9);
  EXPECT_NEAR(RangeSensor::preset("lidar").vertical_angle_rad(), 90 * kDegree, 1e-9);
  EXPECT_NEAR(RangeSensor::preset("panoramic").vertical_angle_rad(), 180 * kDegree, 1e-9);
  EXPECT_TRUE(RangeSensor::preset("lidar").reports_no_return);
  EXPECT_FALSE(stereo.reports_no_return);
}

TEST(RangeSensor, AnUnknownPresetListsThoseThereAre) {
  try {
    (void)RangeSensor::preset("sonar");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "there is no sensor \"sonar\"; there are kinect, stereo, realsense, lidar, panoramic, vpl");
  }
}

TEST(RangeSensor, NamesTheFieldAtFault) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  RangeSensor good = RangeSensor::preset("kinect");
  const auto with = [&](auto change) {
    RangeSensor sensor = good;
    change(sensor);
    return complaint(sensor);
  };
  EXPECT_EQ(with([](RangeSensor& s) { s.width = 0; }), "RangeSensor::width is 0, must be > 0");
  EXPECT_EQ(with([](RangeSensor& s) { s.height = 0; }), "RangeSensor::height is 0, must be > 0");
  EXPECT_EQ(with([](RangeSensor& s) { s.width = s.height = 4096; }), "");
  EXPECT_EQ(with([](RangeSensor& s) { s.width = s.height = 100'000; }),
            "RangeSensor::width is 100000, must be at most 16777216 / height: no more rays than that");
  EXPECT_EQ(with([](RangeSensor& s) { s.height = std::size_t{1} << 63U; }),
            "RangeSensor::width is 640, must be at most 16777216 / height: no more rays than that");
  EXPECT_EQ(with([](RangeSensor& s) { s.fx = 0; }), "RangeSensor::fx is 0, must be in [1e-3, 1e7]");
  EXPECT_EQ(with([](RangeSensor& s) { s.fy = -1; }), "RangeSensor::fy is -1, must be in [1e-3, 1e7]");
  EXPECT_EQ(with([](RangeSensor& s) { s.cx = kNan; }), "RangeSensor::cx is nan, must be in [-1e6, 1e6]");
  EXPECT_EQ(with([](RangeSensor& s) { s.cy = kNan; }), "RangeSensor::cy is nan, must be in [-1e6, 1e6]");
  EXPECT_EQ(with([](RangeSensor& s) { s.min_range_m = -0.5; }), "RangeSensor::min_range_m is -0.5, must be >= 0");
  EXPECT_EQ(with([](RangeSensor& s) { s.max_range_m = -1; }),
            "RangeSensor::max_range_m is -1, must be > min_range_m and at most 10000");
  EXPECT_EQ(with([](RangeSensor& s) { s.max_range_m = std::numeric_limits<double>::infinity(); }),
            "RangeSensor::max_range_m is inf, must be > min_range_m and at most 10000");
  good = RangeSensor::preset("lidar");
  EXPECT_EQ(with([](RangeSensor& s) { s.horizontal_fov_rad = 7; }),
            "RangeSensor::horizontal_fov_rad is 7, must be in [1e-4, 2 pi]");
  EXPECT_EQ(with([](RangeSensor& s) { s.vertical_fov_rad = 0; }),
            "RangeSensor::vertical_fov_rad is 0, must be in [1e-4, pi]");
  EXPECT_EQ(with([](RangeSensor& s) { s.fx = 0; }), "") << "a spherical sensor has no focal length";
  EXPECT_THROW((void)RangeSensor::pinhole(64, 48, std::numbers::pi, 1.0, 0.0, 4.0), std::invalid_argument);
}

TEST(RangeSensor, EveryDirectionIsAUnitVectorInView) {
  std::size_t checked = 0;
  for (const std::string_view name : RangeSensor::preset_names()) {
    const RangeSensor sensor = RangeSensor::preset(name);
    const std::vector<Eigen::Vector3f> directions = sensor.directions();
    ASSERT_EQ(directions.size(), sensor.width * sensor.height);
    for (std::size_t i = 0; i < directions.size(); i += 37) {
      EXPECT_NEAR(directions[i].norm(), 1.0F, 1e-6F);
      ASSERT_TRUE(sensor.in_view(3.0 * directions[i].cast<double>())) << name << " " << i;
      ++checked;
    }
  }
  EXPECT_GT(checked, 30'000U);
}

// A pinhole sensor sees exactly what projects into its image, a spherical one what lies between its angles. Tested
// with independent code.
TEST(RangeSensor, SeesWhatLiesBetweenItsAngles) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  std::size_t seen = 0;
  const RangeSensor kinect = RangeSensor::preset("kinect");
  const RangeSensor lidar = RangeSensor::preset("lidar");
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d d(normal(engine), normal(engine), normal(engine));
    const bool in_kinect = d.z() > 0 && std::abs(d.x()) < d.z() * std::tan(28.5 * kDegree) &&
                           std::abs(d.y()) < d.z() * std::tan(21.5 * kDegree);
    EXPECT_EQ(kinect.in_view(d), in_kinect);
    EXPECT_EQ(lidar.in_view(d), std::abs(d.y()) < d.norm() * std::sin(45 * kDegree));
    seen += in_kinect ? 1U : 0U;
  }
  EXPECT_GT(seen, 500U);
  EXPECT_FALSE(kinect.in_view(Eigen::Vector3d::Zero()));
}

TEST(RangeSensor, ImageAxesAreRightAndDown) {
  for (const char* name : {"kinect", "panoramic"}) {
    const RangeSensor sensor = RangeSensor::preset(name);
    const std::size_t column = sensor.width / 2;
    const std::size_t row = sensor.height / 2;
    EXPECT_GT(sensor.direction(column, row).z(), 0.99) << name;
    EXPECT_GT(sensor.direction(column + 50, row).x(), 0.05) << name;
    EXPECT_GT(sensor.direction(column, row + 50).y(), 0.05) << name;
  }
}

TEST(RangeSensor, ReducedRaysAreNoFurtherApartThanTheCell) {
  std::size_t compared = 0;
  for (const std::string_view name : RangeSensor::preset_names()) {
    const RangeSensor full = RangeSensor::preset(name);
    for (const double cell_m : {0.02, 0.1, 0.5, 1e3}) {
      const RangeSensor reduced = full.rays_for(cell_m);
      EXPECT_EQ(complaint(reduced), "");
      EXPECT_LE(reduced.width, full.width);
      EXPECT_LE(reduced.height, full.height);
      EXPECT_NEAR(reduced.horizontal_angle_rad(), full.horizontal_angle_rad(), 1e-9);
      EXPECT_NEAR(reduced.vertical_angle_rad(), full.vertical_angle_rad(), 1e-9);
      for (std::size_t column = 1; column < reduced.width && reduced.width < full.width; ++column) {
        const std::size_t row = reduced.height / 2;
        const Eigen::Vector3d step = reduced.direction(column, row) - reduced.direction(column - 1, row);
        EXPECT_LE(step.norm() * full.max_range_m, cell_m * (1 + 1e-9));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 300U);
  EXPECT_THROW((void)RangeSensor::preset("kinect").rays_for(0.0), std::invalid_argument);
}

TEST(RangeSensor, NeighbouringRaysAreACellApartAtTheResolvingRange) {
  for (const std::string_view name : RangeSensor::preset_names()) {
    const RangeSensor sensor = RangeSensor::preset(name);
    const double cell_m = 0.1;
    const double range_m = sensor.resolving_range_m(cell_m);
    const std::size_t column = sensor.width / 2;
    const std::size_t row = sensor.height / 2;
    const Eigen::Vector3d ray = sensor.direction(column, row);
    const double across_m = range_m * (sensor.direction(column + 1, row) - ray).norm();
    const double down_m = range_m * (sensor.direction(column, row + 1) - ray).norm();
    EXPECT_NEAR(std::max(across_m, down_m), cell_m, 1e-3 * cell_m) << name;
    EXPECT_DOUBLE_EQ(sensor.resolving_range_m(2.0 * cell_m), 2.0 * range_m) << name;
  }
}

}  // namespace
}  // namespace vantage
