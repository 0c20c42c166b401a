// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vantage/report/sensor_file.hpp>

namespace vantage {
namespace {

class SensorFile : public testing::Test {
 protected:
  SensorFile()
      : file_(std::filesystem::temp_directory_path() /
              ("vantage_sensor_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name() + ".json")) {}
  ~SensorFile() override { std::filesystem::remove(file_); }

  RangeSensor load(const std::string& text) {
    std::ofstream(file_) << text;
    return load_sensor(file_);
  }
  std::string error_of(const std::string& text) {
    try {
      (void)load(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "(accepted)";
  }
  std::filesystem::path file_;
};

TEST_F(SensorFile, ReadsAPinholeByAngles) {
  const RangeSensor sensor = load(R"({"width": 64, "height": 48, "horizontal_fov_deg": 57, "vertical_fov_deg": 43,
                                      "min_range_m": 0.4, "max_range_m": 4})");
  EXPECT_EQ(sensor.projection, RangeSensor::Projection::Pinhole);
  EXPECT_EQ(sensor.width, 64U);
  EXPECT_NEAR(sensor.horizontal_angle_rad(), 57.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_NEAR(sensor.vertical_angle_rad(), 43.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_EQ(sensor.min_range_m, 0.4);
  EXPECT_EQ(sensor.max_range_m, 4.0);
  EXPECT_FALSE(sensor.reports_no_return);
}

TEST_F(SensorFile, ReadsAPinholeByFocalLength) {
  const RangeSensor sensor =
      load(R"({"projection": "pinhole", "width": 64, "height": 48, "fx": 50, "fy": 51.5, "cx": 30,
                                      "max_range_m": 4})");
  EXPECT_EQ(sensor.fx, 50.0);
  EXPECT_EQ(sensor.fy, 51.5);
  EXPECT_EQ(sensor.cx, 30.0);
  EXPECT_EQ(sensor.cy, 23.5);
}

TEST_F(SensorFile, ReadsASphericalSensorInRadians) {
  const RangeSensor sensor =
      load(R"({"projection": "spherical", "width": 360, "height": 32, "horizontal_fov_rad": 6.2,
                                      "vertical_fov_rad": 0.5, "max_range_m": 30, "reports_no_return": true})");
  EXPECT_EQ(sensor.projection, RangeSensor::Projection::Spherical);
  EXPECT_EQ(sensor.horizontal_fov_rad, 6.2);
  EXPECT_EQ(sensor.vertical_fov_rad, 0.5);
  EXPECT_TRUE(sensor.reports_no_return);
}

TEST_F(SensorFile, SaysWhatIsWrongAndWhere) {
  struct Case {
    const char* text;
    const char* says;
  };
  const Case cases[] = {
      {"{\"width\": 64,\n \"height\": }", "line 2"},
      {"", "not JSON"},
      {"[1, 2]", "array"},
      {R"({"width": 64, "hight": 48})", "unknown field 'hight'"},
      {R"({"width": "64", "height": 48, "fx": 1, "fy": 1, "max_range_m": 4})", "'width' is \"64\""},
      {R"({"width": 0, "height": 48, "fx": 1, "fy": 1, "max_range_m": 4})", "'width' is 0"},
      {R"({"width": 64.5, "height": 48, "fx": 1, "fy": 1, "max_range_m": 4})", "'width' is 64.5"},
      {R"({"width": 64, "height": 48, "fx": 1, "fy": 1})", "'max_range_m' is missing"},
      {R"({"width": 64, "height": 48, "fx": 1, "fy": 1, "max_range_m": -4})", "max_range_m is -4"},
      {R"({"width": 64, "height": 48, "fx": 1, "fy": 1, "min_range_m": -1, "max_range_m": 4})", "min_range_m is -1"},
      {R"({"width": 64, "height": 48, "fx": 0, "fy": 1, "max_range_m": 4})", "fx is 0"},
      {R"({"width": 64, "height": 48, "max_range_m": 4})", "'horizontal_fov_deg'"},
      {R"({"width": 64, "height": 48, "horizontal_fov_deg": 50, "max_range_m": 4})", "both angles"},
      {R"({"width": 64, "height": 48, "horizontal_fov_deg": 50, "vertical_fov_deg": 200, "max_range_m": 4})",
       "vertical_fov_rad"},
      {R"({"width": 64, "height": 48, "horizontal_fov_deg": 50, "horizontal_fov_rad": 1, "max_range_m": 4})",
       "both 'horizontal_fov_rad'"},
      {R"({"width": 64, "height": 48, "horizontal_fov_deg": 50, "vertical_fov_deg": 40, "fx": 1, "max_range_m": 4})",
       "not both"},
      {R"({"projection": "fisheye", "width": 64, "height": 48, "fx": 1, "fy": 1, "max_range_m": 4})", "fisheye"},
      {R"({"projection": "spherical", "width": 64, "height": 48, "fx": 1, "max_range_m": 4})",
       "'fx' belongs to a pinhole"},
      {R"({"width": 64, "height": 48, "fx": 1, "fy": 1, "max_range_m": 4, "reports_no_return": 1})",
       "'reports_no_return' is 1"},
      {R"({"width": 64, "height": 48, "fx": 1, "fy": 1, "max_range_m": 1e999})", "1e999"},
      {R"({"width": 100000, "height": 100000, "fx": 1, "fy": 1, "max_range_m": 4})", "at most 16777216 / height"},
      {R"({"width": 64, "height": 48, "fx": 1, "fy": 1, "cx": 1e300, "max_range_m": 4})", "cx is 1e+300"},
      {R"({"width": 64, "height": 48, "fx": 1, "fy": 1, "max_range_m": 1e30})", "max_range_m is 1e+30"},
  };
  std::size_t ran = 0;
  for (const Case& wrong : cases) {
    const std::string error = error_of(wrong.text);
    EXPECT_EQ(error.rfind(file_.string(), 0), 0U) << error;
    EXPECT_NE(error.find(wrong.says), std::string::npos) << wrong.text << "\n gave: " << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    ++ran;
  }
  EXPECT_EQ(ran, 23U);
}

TEST_F(SensorFile, NamesAMissingFile) {
  EXPECT_THROW((void)load_sensor("/nowhere/sensor.json"), std::runtime_error);
  EXPECT_THROW((void)load_sensor(std::filesystem::temp_directory_path()), std::runtime_error);
}

}  // namespace
}  // namespace vantage
