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
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// One moment of a recording: where the sensor was, and the files of what it saw.
struct RecordedFrame {
  std::string name;                          ///< as its files have it, or its time stamp
  Pose world_from_posed = Pose::Identity();  ///< pose of the camera that the recording's poses speak of
  std::filesystem::path depth = {};          ///< depth image, left image of a stereo pair, or range scan
  std::filesystem::path right = {};          ///< right image of a stereo pair, or empty
  std::filesystem::path colour = {};         ///< picture of the same moment, or empty
};

/// A moment of a recording that cannot be used.
struct SkippedFrame {
  std::string name;    ///< as RecordedFrame::name
  std::string reason;  ///< one sentence, for a person
};

/// How a recording is opened. What is not given is as its files or its format have it.
struct RecordingOptions {
  std::optional<double> max_range_m = std::nullopt;  ///< see DepthCamera::max_range_m
  std::optional<double> min_range_m = std::nullopt;  ///< see DepthCamera::min_range_m
  /// fx, fy, cx, cy of the depth images, pixels: of the formats whose files need not tell, tum and 7scenes; refused
  /// for the others.
  std::optional<std::array<double, 4>> intrinsics = std::nullopt;
  double max_stamp_gap_s = 0.02;  ///< time stamps further apart than this have nothing to do with each other, > 0
  double cell_m =
      0.1;  ///< cells of the map to be made, metres: stereo is trusted as far as it lands in the right one
};

/// What a frame holds, read and turned into a scan.
struct RecordedReading {
  DepthImage depth;  ///< in the depth camera's own pixels; of range scans, as a camera in the scanner's place has it
  DepthScan scan;    ///< ready for the map
};

/// A recording of posed depth images, stereo pairs or range scans, made by others, in their format:
///
/// | format | files |
/// |---|---|
/// | tum | `depth.txt`, `groundtruth.txt`, `rgb.txt` or none: stamps, joined by the nearest; depth 5000 to a metre |
/// | 7scenes | `frame-NNNNNN.depth.png` in mm, `.pose.txt` 4 x 4, `.color.png` or `.jpg`; `camera-intrinsics.txt` |
/// | apc | `cam.info.txt`; `decoded/*.depth_dmm.png` in 0.1 mm, or as the driver wrote it, `raw/*.depth.png` |
/// | kitti-stereo | `image_l`, `image_r` (or KITTI's own names), `calib.txt`, `poses.txt`, a row for every pair |
/// | stanford | range scans `*.ply` in words, or packed `*.ply.gz`, of an object; `*.conf`, a line with the pose of
/// each |
///
///     Recording recording = Recording::open("7scenes", folder);
///     for (std::size_t i = 0; i < recording.frames().size(); ++i)
///       map.insert(recording.read(i).scan.scan);
///
/// Opening reads lists and poses; images are read one by one. Frames that lack a pose, a partner or a file are left
/// out and told in `skipped`; nothing else is lost. Poses are made exactly rigid where rounding has left them nearly
/// so, quaternions are normalised, and worlds with the axes of a camera (7scenes, kitti-stereo) or with +y up
/// (stanford) are turned until +z is up.
class Recording {
 public:
  /// Throws std::runtime_error with the folder or file and what is wrong with it (nothing to read in it counts),
  /// std::invalid_argument for an unknown format (naming those there are) or a bad option.
  [[nodiscard]] static Recording open(std::string_view format, const std::filesystem::path& folder,
                                      const RecordingOptions& options = {});
  /// The formats `open` knows.
  [[nodiscard]] static const std::vector<std::string_view>& formats();

  /// Frames with a pose, in order of time.
  [[nodiscard]] const std::vector<RecordedFrame>& frames() const { return frames_; }
  /// Frames left out, in order of time, with the reason.
  [[nodiscard]] const std::vector<SkippedFrame>& skipped() const { return skipped_; }
  /// How many poses came with a quaternion whose length was off 1 by more than 0.001.
  [[nodiscard]] std::size_t normalised() const { return normalised_; }
  /// The camera whose images are read.
  [[nodiscard]] const DepthCamera& camera() const { return camera_; }
  /// The same, for planners.
  [[nodiscard]] RangeSensor sensor() const { return camera_.range_sensor(); }
  /// Where the sensor was at a frame, `world_from_sensor`.
  [[nodiscard]] Pose pose(std::size_t frame) const {
    return frames_.at(frame).world_from_posed * camera_.posed_from_depth;
  }
  /// Reads a frame. Throws std::runtime_error with the file and what is wrong with it: a host may count that and go
  /// on with the next. std::out_of_range if there is no such frame.
  [[nodiscard]] RecordedReading read(std::size_t frame) const;

 private:
  friend class RecordingReader;
  Recording() = default;

  DepthCamera camera_;
  std::vector<RecordedFrame> frames_;
  std::vector<SkippedFrame> skipped_;
  std::size_t normalised_ = 0;
  std::function<RecordedReading(const RecordedFrame&, const DepthCamera&)> read_;
};

}  // namespace vantage
