// SPDX-License-Identifier: MIT
// "7-Scenes" (Shotton et al. 2013): Kinect frames with poses from KinectFusion.
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "vision/pose_text.hpp"
#include "vision/recording_reader.hpp"

namespace vantage {
namespace {

constexpr const char* kDepth = ".depth.png";

std::vector<double> rows_in(const std::filesystem::path& file) {
  std::vector<double> rows;
  for (const detail::TextLine& line : detail::lines_of(file)) {
    const auto numbers = detail::numbers_in(line.text);
    if (!numbers) {
      throw std::runtime_error(file.string() + ": line " + std::to_string(line.number) + " is not a row of numbers");
    }
    rows.insert(rows.end(), numbers->begin(), numbers->end());
  }
  return rows;
}

// nullopt if the file is not a rigid transform of 4 rows of 4 numbers.
std::optional<Pose> pose_in(const std::filesystem::path& file) {
  std::vector<double> rows;
  for (const detail::TextLine& line : detail::lines_of(file)) {
    const std::vector<double> row = detail::numbers_in(line.text).value_or(std::vector<double>{});
    rows.insert(rows.end(), row.begin(), row.end());
  }
  return rows.size() == 16 ? detail::pose_of_rows(rows) : std::nullopt;
}

// The camera of a file, or the usual one if there is no such file.
DepthCamera camera_in(const std::filesystem::path& file) {
  DepthCamera camera{.fx = 585.0, .fy = 585.0, .cx = 320.0, .cy = 240.0};
  if (std::filesystem::exists(file)) {
    const std::vector<double> rows = rows_in(file);
    if (rows.size() != 9) {
      throw std::runtime_error(file.string() + ": has " + std::to_string(rows.size()) +
                               " numbers, must have 3 rows of 3");
    }
    camera.fx = rows[0];
    camera.cx = rows[2];
    camera.fy = rows[4];
    camera.cy = rows[5];
  }
  camera.max_range_m = 4.0;  // reliable range of a Kinect
  camera.min_range_m = 0.4;
  camera.noise = {.constant_m = 0.0012, .quadratic_per_m = 0.0019};  // axial noise, Nguyen, Izadi & Lovell 2012
  return camera;
}

}  // namespace

Recording open_seven_scenes(RecordingReader reader) {
  for (const std::filesystem::path& depth : files_ending(reader.folder(), kDepth)) {
    RecordedFrame frame{.name = name_without(depth, kDepth), .depth = depth};
    const auto beside = [&](const char* ending) { return reader.folder() / (frame.name + ending); };
    if (!std::filesystem::exists(beside(".pose.txt"))) {
      reader.skip(frame.name, "there is no " + frame.name + ".pose.txt");
      continue;
    }
    const std::optional<Pose> pose = pose_in(beside(".pose.txt"));
    if (!pose) {
      reader.skip(frame.name, frame.name + ".pose.txt is not a rigid transform of 4 rows of 4 numbers");
      continue;
    }
    frame.world_from_posed = *pose;
    for (const char* ending : {".color.png", ".color.jpg"}) {
      if (std::filesystem::exists(beside(ending))) {
        frame.colour = beside(ending);
      }
    }
    reader.add(std::move(frame));
  }
  for (const std::filesystem::path& pose : files_ending(reader.folder(), ".pose.txt")) {
    const std::string name = name_without(pose, ".pose.txt");
    if (!std::filesystem::exists(reader.folder() / (name + kDepth))) {
      reader.skip(name, "there is no " + name + kDepth);
    }
  }
  reader.set_up("-y");
  reader.read_depth_png_as({.units_per_m = 1000.0});
  const std::filesystem::path intrinsics = reader.folder() / "camera-intrinsics.txt";
  if (!std::filesystem::exists(intrinsics) && !reader.options().intrinsics) {
    reader.assume("there is no camera-intrinsics.txt: fx = fy = 585, cx = 320, cy = 240 are assumed");
  }
  return reader.finish(camera_in(intrinsics), intrinsics);
}

}  // namespace vantage
