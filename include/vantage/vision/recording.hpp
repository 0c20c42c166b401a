// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/vision/depth_camera.hpp>
#include <vantage/vision/depth_image.hpp>
#include <vantage/vision/stereo_matcher.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// One frame of a recording: a pose and the files of the measurement.
struct RecordedFrame {
  std::string name;                          ///< taken from its files, or the time stamp
  Pose world_from_posed = Pose::Identity();  ///< pose of the camera that the poses of the recording refer to
  std::filesystem::path depth = {};          ///< depth image, left image of a stereo pair, or range scan
  std::filesystem::path right = {};          ///< right image of a stereo pair, or empty
  std::filesystem::path colour = {};         ///< colour image of the same moment, or empty
};

/// A frame that cannot be used.
struct SkippedFrame {
  std::string name;    ///< as RecordedFrame::name
  std::string reason;  ///< one sentence for the user
};

/// How a recording is opened. Options that are not set come from the files or the format.
struct RecordingOptions {
  std::optional<double> max_range_m = std::nullopt;  ///< see DepthCamera::max_range_m
  std::optional<double> min_range_m = std::nullopt;  ///< see DepthCamera::min_range_m
  /// fx, fy, cx, cy of the depth images, pixels. Only for the formats tum and 7scenes, whose files need not contain
  /// them; not allowed for other formats.
  std::optional<std::array<double, 4>> intrinsics = std::nullopt;
  /// largest time difference, seconds, between a depth image and its pose or picture, > 0
  double max_stamp_gap_s = 0.02;
  /// How pairs are matched. Only for the format kitti-stereo; not allowed for other formats.
  std::optional<StereoOptions> stereo = std::nullopt;
  /// The axis of the poses' world that points up: x, -x, y, -y, z or -z; empty: the one that is up in the images, if
  /// they agree, else as the format says
  std::string up = {};
  double cell_m =
      0.1;  ///< cell size of the map, metres: stereo depth is trusted while its uncertainty is below one cell
};

/// The data of a frame, also converted to a scan.
struct RecordedReading {
  /// depth image in the pixels of the depth camera; for range scans, the view of an equivalent camera
  DepthImage depth;
  DepthScan scan;  ///< ready for OccupancyMap::insert
};

/// A recording of posed depth images, stereo pairs or range scans, in a public format:
///
/// | format | files |
/// |---|---|
/// | tum | `depth.txt`, `groundtruth.txt`, optional `rgb.txt`, matched by time stamp; depth in 1/5000 m |
/// | 7scenes | `frame-NNNNNN.depth.png` in mm, `.pose.txt` 4 x 4, `.color.png` or `.jpg`; `camera-intrinsics.txt` |
/// | apc | `cam.info.txt`; `decoded/*.depth_dmm.png` in 0.1 mm, or the driver's `raw/*.depth.png` |
/// | kitti-stereo | `image_l`, `image_r` (or KITTI's own names), `calib.txt`, `poses.txt` with a row per pair |
/// | stanford | range scans `*.ply` (ASCII) or `*.ply.gz` of an object; `*.conf` with a line per scan pose |
///
///     Recording recording = Recording::open("7scenes", folder);
///     for (std::size_t i = 0; i < recording.frames().size(); ++i)
///       map.insert(recording.read(i).scan.scan);
///
/// Opening reads only lists, poses and the image size; images are read one by one. Frames without a pose, a partner
/// image or a file are left out and listed in `skipped`. Poses are corrected for rounding so that they are rigid, and
/// quaternions are normalised. The world is rotated so that +z is up.
class Recording {
 public:
  /// Throws std::runtime_error, with the folder or file and the reason, if it cannot be read, has no usable frame or
  /// describes no valid camera. Throws std::invalid_argument for an unknown format (and lists the formats) or an
  /// invalid option, which it names.
  [[nodiscard]] static Recording open(std::string_view format, const std::filesystem::path& folder,
                                      const RecordingOptions& options = {});
  /// The names of the supported formats.
  [[nodiscard]] static const std::vector<std::string_view>& formats();

  /// The usable frames, in the order of their time stamps, file names or list.
  [[nodiscard]] const std::vector<RecordedFrame>& frames() const { return frames_; }
  /// The frames that were left out, with the reason.
  [[nodiscard]] const std::vector<SkippedFrame>& skipped() const { return skipped_; }
  /// The number of poses whose quaternion had a length that differed from 1 by more than 0.001.
  [[nodiscard]] std::size_t normalised() const { return normalised_; }
  /// The axis of the poses' world that was taken to point up, and became +z.
  [[nodiscard]] const std::string& up() const { return up_; }
  /// The axis that points up in this format; it differs from `up` where an option or the images say otherwise.
  [[nodiscard]] const std::string& up_of_format() const { return up_of_format_; }
  /// What was taken for granted about the camera because a file of the format is missing, one sentence; else empty.
  [[nodiscard]] const std::string& assumed() const { return assumed_; }
  /// The depth camera of the recording.
  [[nodiscard]] const DepthCamera& camera() const { return camera_; }
  /// The sensor model of the depth camera, for planners.
  [[nodiscard]] RangeSensor sensor() const { return camera_.range_sensor(); }
  /// Pose of the sensor at a frame, `world_from_sensor`. Throws std::out_of_range if there is no such frame.
  [[nodiscard]] Pose pose(std::size_t frame) const {
    return frames_.at(frame).world_from_posed * camera_.posed_from_depth;
  }
  /// Reads a frame. Throws std::runtime_error, with the file and the reason, if it is damaged; the host can continue
  /// with the next frame. Throws std::out_of_range if there is no such frame.
  [[nodiscard]] RecordedReading read(std::size_t frame) const;

 private:
  friend class RecordingReader;
  Recording() = default;

  DepthCamera camera_;
  std::vector<RecordedFrame> frames_;
  std::vector<SkippedFrame> skipped_;
  std::size_t normalised_ = 0;
  std::string up_ = "z";
  std::string up_of_format_;
  std::string assumed_;
  std::function<RecordedReading(const RecordedFrame&, const DepthCamera&)> read_;
};

}  // namespace vantage
