// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vantage/vision/recording.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "vision/recording_reader.hpp"

namespace vantage {
namespace {

using Opener = Recording (*)(RecordingReader);

const std::vector<std::pair<std::string_view, Opener>>& openers() {
  static const std::vector<std::pair<std::string_view, Opener>> all{
      {"7scenes", open_seven_scenes}, {"apc", open_apc}, {"kitti-stereo", open_kitti_stereo},
      {"stanford", open_stanford},    {"tum", open_tum},
  };
  return all;
}

// The axes that may point up, and the rotations that make them +z.
struct UpAxis {
  std::string_view name;
  std::array<double, 9> rotation;  // row by row
};
constexpr std::array<UpAxis, 6> kUpAxes{{{"x", {0, 1, 0, 0, 0, 1, 1, 0, 0}},
                                         {"-x", {0, -1, 0, 0, 0, 1, -1, 0, 0}},
                                         {"y", {1, 0, 0, 0, 0, -1, 0, 1, 0}},
                                         {"-y", {0, 0, 1, -1, 0, 0, 0, -1, 0}},
                                         {"z", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                                         {"-z", {1, 0, 0, 0, -1, 0, 0, 0, -1}}}};

const UpAxis* up_axis(std::string_view name) {
  const auto* found =
      std::find_if(kUpAxes.begin(), kUpAxes.end(), [&](const UpAxis& axis) { return axis.name == name; });
  return found == kUpAxes.end() ? nullptr : found;
}

Eigen::Matrix3d rotation_of(const UpAxis& axis) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(axis.rotation.data());
}

void check(const RecordingOptions& options) {
  if (!options.up.empty() && up_axis(options.up) == nullptr) {
    throw std::invalid_argument("RecordingOptions::up is '" + options.up + "', must be x, -x, y, -y, z or -z");
  }
  detail::require_option(std::isfinite(options.max_stamp_gap_s) && options.max_stamp_gap_s > 0.0,
                         "RecordingOptions::max_stamp_gap_s", options.max_stamp_gap_s, "> 0");
  detail::require_option(std::isfinite(options.cell_m) && options.cell_m > 0.0, "RecordingOptions::cell_m",
                         options.cell_m, "> 0");
  if (options.max_range_m) {
    detail::require_option(std::isfinite(*options.max_range_m) && *options.max_range_m > 0.0,
                           "RecordingOptions::max_range_m", *options.max_range_m, "> 0");
  }
  if (options.min_range_m) {
    detail::require_option(std::isfinite(*options.min_range_m) && *options.min_range_m >= 0.0,
                           "RecordingOptions::min_range_m", *options.min_range_m, ">= 0");
  }
  if (options.intrinsics) {
    const auto& [fx, fy, cx, cy] = *options.intrinsics;
    const char* const name = "RecordingOptions::intrinsics";
    detail::require_option(std::isfinite(fx) && fx > 0.0, name, fx, "> 0 (fx)");
    detail::require_option(std::isfinite(fy) && fy != 0.0, name, fy, "finite and not 0 (fy)");
    detail::require_option(std::isfinite(cx), name, cx, "finite (cx)");
    detail::require_option(std::isfinite(cy), name, cy, "finite (cy)");
  }
}

}  // namespace

Recording Recording::open(std::string_view format, const std::filesystem::path& folder,
                          const RecordingOptions& options) {
  check(options);
  for (const auto& [name, open] : openers()) {
    if (name == format) {
      if (!std::filesystem::is_directory(folder)) {
        throw std::runtime_error(folder.string() + ": is not a folder");
      }
      if (options.intrinsics && name != "tum" && name != "7scenes") {
        throw std::invalid_argument("RecordingOptions::intrinsics: the files of a recording '" + std::string(name) +
                                    "' tell them");
      }
      if (options.stereo && name != "kitti-stereo") {
        throw std::invalid_argument("RecordingOptions::stereo: a recording '" + std::string(name) +
                                    "' has no pairs to match");
      }
      return open(RecordingReader(folder, options));
    }
  }
  std::string names;
  for (const std::string_view name : formats()) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw std::invalid_argument("there is no format '" + std::string(format) + "'; there are: " + names);
}

const std::vector<std::string_view>& Recording::formats() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const auto& [name, open] : openers()) {
      all.push_back(name);
    }
    return all;
  }();
  return names;
}

RecordedReading Recording::read(std::size_t frame) const { return read_(frames_.at(frame), camera_); }

void RecordingReader::read_depth_by(std::function<DepthImage(const RecordedFrame&)> read) {
  read_depth_ = std::move(read);
  read_by([read_depth = read_depth_](const RecordedFrame& wanted, const DepthCamera& camera) {
    RecordedReading reading{read_depth(wanted), {}};
    if (reading.depth.width != camera.width || reading.depth.height != camera.height) {
      throw std::runtime_error(wanted.depth.string() + ": is " + std::to_string(reading.depth.width) + " x " +
                               std::to_string(reading.depth.height) + " pixels, the recording's first image is " +
                               std::to_string(camera.width) + " x " + std::to_string(camera.height));
    }
    reading.scan = depth_scan(reading.depth, camera, wanted.world_from_posed);
    return reading;
  });
}

void RecordingReader::read_depth_png_as(DepthEncoding encoding) {
  read_depth_by(
      [encoding = std::move(encoding)](const RecordedFrame& frame) { return read_depth_png(frame.depth, encoding); });
}

// Takes the size of the first image that can be read: the first file may be damaged.
void RecordingReader::set_size(DepthCamera& camera) const {
  std::string unread;
  for (const RecordedFrame& frame : recording_.frames_) {
    try {
      const DepthImage first = read_depth_(frame);
      camera.width = first.width;
      camera.height = first.height;
      return;
    } catch (const std::runtime_error& error) {
      unread = unread.empty() ? error.what() : unread;
    }
  }
  throw std::runtime_error(folder_.string() + ": none of its images can be read; the first: " + unread);
}

void RecordingReader::set_ranges(DepthCamera& camera) const {
  camera.max_range_m = options_.max_range_m.value_or(camera.max_range_m);
  camera.min_range_m = options_.min_range_m.value_or(camera.min_range_m);
  if (options_.min_range_m) {
    detail::require_option(camera.min_range_m < camera.trusted_range_m(), "RecordingOptions::min_range_m",
                           camera.min_range_m, "< the trusted range, " + std::to_string(camera.trusted_range_m()));
  } else if (options_.max_range_m) {
    detail::require_option(camera.max_range_m > camera.min_range_m, "RecordingOptions::max_range_m",
                           camera.max_range_m, "> the smallest range, " + std::to_string(camera.min_range_m));
  }
}

// Cameras are held upright: the mean of what is up in the images points to the axis that is up.
void RecordingReader::turn_upright() {
  recording_.up_of_format_ = recording_.up_;
  if (!options_.up.empty()) {
    recording_.up_ = options_.up;
  } else {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < recording_.frames_.size(); ++i) {
      // A negative fy: the rows of the images count upwards.
      mean += std::copysign(1.0, recording_.camera_.fy) * -recording_.pose(i).linear().col(1);
    }
    mean /= static_cast<double>(recording_.frames_.size());
    for (const UpAxis& axis : kUpAxes) {
      constexpr double kAgreeing = 0.75;  // clearly nearer to this axis than to any other
      if (rotation_of(axis).row(2).dot(mean) > kAgreeing) {
        recording_.up_ = axis.name;
      }
    }
  }
  Pose turn = Pose::Identity();
  turn.linear() = rotation_of(*up_axis(recording_.up_));
  for (RecordedFrame& frame : recording_.frames_) {
    frame.world_from_posed = turn * frame.world_from_posed;
  }
}

Recording RecordingReader::finish(DepthCamera camera, const std::filesystem::path& file, bool sized) {
  if (recording_.frames_.empty()) {
    const std::string why = recording_.skipped_.empty()
                                ? std::string()
                                : "; the first one left out is " + recording_.skipped_.front().name + ": " +
                                      recording_.skipped_.front().reason;
    throw std::runtime_error(folder_.string() + ": there is no frame to read in it" + why);
  }
  if (!sized) {
    set_size(camera);
  }
  if (options_.intrinsics) {
    const auto& [fx, fy, cx, cy] = *options_.intrinsics;
    camera.fx = fx;
    camera.fy = fy;
    camera.cx = cx;
    camera.cy = cy;
  }
  try {
    camera.validate();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  set_ranges(camera);
  recording_.camera_ = camera;
  turn_upright();
  return std::move(recording_);
}

std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder, const std::string& ending) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
        files.push_back(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string name_without(const std::filesystem::path& file, const std::string& ending) {
  const std::string name = file.filename().string();
  return name.substr(0, name.size() - ending.size());
}

}  // namespace vantage
