// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/vision/depth_camera.hpp>
#include <vantage/vision/depth_image.hpp>
#include <vantage/vision/stereo_rig.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How left and right pixels are matched.
enum class StereoMethod : std::uint8_t {
  SemiGlobal,  ///< OpenCV's StereoSGBM, Hirschmueller 2008
  Block,       ///< OpenCV's StereoBM: windows by the sum of absolute differences, as Shade & Newman 2011, V-1
};

/// Options of a StereoMatcher.
struct StereoOptions {
  StereoMethod method = StereoMethod::SemiGlobal;  ///< see StereoMethod
  int least_disparity_px = 0;                      ///< where the search begins
  int disparities_px = 128;                        ///< how far it goes, > 0, a multiple of 16
  int window_px = 5;            ///< edge of a matched window, odd, in [1, 255]; Block takes at least 5
  int uniqueness_percent = 10;  ///< the best match must beat the second best by this, in [0, 100]
  /// A match must be found again from right to left, to within this, pixels; negative: not asked.
  int left_right_px = 1;
  int speckle_pixels = 100;      ///< islands of fewer pixels are dropped; 0: none
  double speckle_step_px = 2.0;  ///< where the disparity steps by more, an island ends, >= 0
  /// Least texture: the mean absolute slope of brightness along the row over the window, in grey values per pixel,
  /// >= 0. Where there is less, a match is a guess. 0: all is matched.
  double least_texture = 1.0;
  double sigma_d_px = 0.5;  ///< how uncertain a disparity is, one standard deviation, > 0
};

/// What became of the pixels of a pair: each is counted once.
struct StereoReport {
  std::size_t matched = 0;      ///< have a depth
  std::size_t unmatched = 0;    ///< no match, or not a unique one, or not the same from right to left
  std::size_t speckle = 0;      ///< in a small island
  std::size_t textureless = 0;  ///< matched, but too plain to be believed
};

/// What a pair shows, in the pixels of the left rectified image.
struct StereoDepth {
  std::vector<float> disparity_px;  ///< row by row; NaN where there is none
  DepthImage depth;                 ///< the same as depth; NaN where there is none: such a pixel frees nothing
  StereoReport report;              ///< the pixels by what became of them
};

/// Depth from pairs of images (Shade & Newman 2011, V-1), by OpenCV's matchers.
///
///     StereoMatcher matcher(read_kitti_calibration("calib.txt"));
///     const StereoDepth seen = matcher.match("left.png", "right.png");
///     map.insert(depth_scan(seen.depth, matcher.camera(0.2), world_from_left).scan);
class StereoMatcher {
 public:
  /// Throws std::invalid_argument naming the field at fault.
  explicit StereoMatcher(const StereoRig& rig, const StereoOptions& options = {});

  /// The rig it was made with.
  [[nodiscard]] const StereoRig& rig() const { return rig_; }
  /// The options it was made with.
  [[nodiscard]] const StereoOptions& options() const { return options_; }
  /// Matches a pair of image files. Throws std::runtime_error with the file and what is wrong with it: it cannot be
  /// read, the two differ in size, or their size is not the rig's. A pair that is not rectified, though the rig says
  /// so, is refused too: of the matches between the two that a search along and across the rows finds, most lie
  /// more than 1.5 pixels off the row.
  [[nodiscard]] StereoDepth match(const std::filesystem::path& left, const std::filesystem::path& right) const;
  /// The left camera as a depth camera for maps of cells of `cell_m`: its range ends where the depth of a match is
  /// uncertain by more than a cell, so that a surface lands in its cell or the next one.
  [[nodiscard]] DepthCamera camera(double cell_m, double max_range_m = 40.0) const;

 private:
  StereoRig rig_;
  StereoOptions options_;
};

}  // namespace vantage
