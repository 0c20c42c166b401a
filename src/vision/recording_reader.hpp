// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vantage/vision/recording.hpp>

namespace vantage {

/// Collects the frames of a recording; filled by the reader of each format.
class RecordingReader {
 public:
  RecordingReader(std::filesystem::path folder, RecordingOptions options)
      : folder_(std::move(folder)), options_(std::move(options)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const RecordingOptions& options() const { return options_; }

  void add(RecordedFrame frame) { recording_.frames_.push_back(std::move(frame)); }
  void skip(std::string name, std::string reason) {
    recording_.skipped_.push_back({std::move(name), std::move(reason)});
  }
  void count_normalised() { ++recording_.normalised_; }
  /// Sets the axis of the poses' world that points up in this format, unless options or the poses say otherwise.
  void set_up(std::string axis) { recording_.up_ = std::move(axis); }
  void assume(std::string what) { recording_.assumed_ = std::move(what); }
  /// Sets how a frame is read, if it is not a depth image.
  void read_by(std::function<RecordedReading(const RecordedFrame&, const DepthCamera&)> read) {
    recording_.read_ = std::move(read);
  }
  void read_depth_by(std::function<DepthImage(const RecordedFrame&)> read);
  /// Frames are depth images in PNG files.
  void read_depth_png_as(DepthEncoding encoding);
  /// Completes the recording. Unless `sized` is true, the size of the camera is taken from the first readable image.
  /// Options override the values of `camera`, which come from `file`. Throws std::runtime_error, with `file`, if the
  /// camera is invalid, and std::invalid_argument, which names the option, if an option makes it invalid.
  [[nodiscard]] Recording finish(DepthCamera camera, const std::filesystem::path& file, bool sized = false);

 private:
  void set_size(DepthCamera& camera) const;
  void set_ranges(DepthCamera& camera) const;
  void turn_upright();

  std::filesystem::path folder_;
  RecordingOptions options_;
  Recording recording_;
  std::function<DepthImage(const RecordedFrame&)> read_depth_;
};

[[nodiscard]] Recording open_tum(RecordingReader reader);
[[nodiscard]] Recording open_seven_scenes(RecordingReader reader);
[[nodiscard]] Recording open_apc(RecordingReader reader);
[[nodiscard]] Recording open_kitti_stereo(RecordingReader reader);
[[nodiscard]] Recording open_stanford(RecordingReader reader);

/// The files of a folder whose names end with `ending`, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder,
                                                              const std::string& ending);
/// The file name without `ending`.
[[nodiscard]] std::string name_without(const std::filesystem::path& file, const std::string& ending);

}  // namespace vantage
