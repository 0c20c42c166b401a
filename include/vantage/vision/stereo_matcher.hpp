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

/// The matching algorithm.
enum class StereoMethod : std::uint8_t {
  SemiGlobal,  ///< OpenCV's StereoSGBM (Hirschmueller 2008)
  Block,  ///< OpenCV's StereoBM: block matching by the sum of absolute differences (as in Shade & Newman 2011, V-1)
};

/// Search range, window and rejection tests of StereoMatcher.
struct StereoOptions {
  StereoMethod method = StereoMethod::SemiGlobal;  ///< matching algorithm
  int least_disparity_px = 0;                      ///< smallest disparity to search
  /// Number of disparities that count, a multiple of 16; 0: enough for surfaces 4 baselines away. A match at either
  /// end of the range is dropped: a nearer or further surface is matched there as well. Those of surfaces at
  /// least 4 baselines away are always searched, because a surface nearer than the range is often matched inside of
  /// it.
  int disparities_px = 0;
  int window_px = 5;            ///< edge of the matching window, odd, in [1, 255]; Block uses at least 5
  int uniqueness_percent = 10;  ///< margin in percent by which the best match must beat the second best, in [0, 100]
  /// Largest difference between left-to-right and right-to-left matching, pixels; negative disables the check.
  int left_right_px = 1;
  int speckle_pixels = 100;      ///< connected regions with fewer pixels are dropped; 0: none
  double speckle_step_px = 2.0;  ///< largest disparity step inside a connected region, >= 0
  /// Smallest texture for a valid match, >= 0: the mean absolute horizontal brightness gradient in the window, in
  /// grey values per pixel. Matches in plainer areas are guesses. 0 disables the check.
  double least_texture = 1.0;
  double sigma_d_px = 0.5;  ///< standard deviation of a disparity, > 0
};

/// Statistics of the pixels of a stereo pair. Each pixel is counted once.
struct StereoReport {
  std::size_t matched = 0;      ///< pixels with a depth
  std::size_t unmatched = 0;    ///< no match in the range, an ambiguous match, or a failed left-right check
  std::size_t speckle = 0;      ///< in a small connected region
  std::size_t textureless = 0;  ///< matched, but with too little texture
};

/// Result for a stereo pair, in the pixels of the rectified left image.
struct StereoDepth {
  std::vector<float> disparity_px;  ///< disparities row by row; NaN if there is none
  DepthImage depth;                 ///< the same as depths; pixels without a depth are NaN and clear nothing
  StereoReport report;              ///< pixel statistics
};

/// Computes depth from stereo pairs with OpenCV's matchers (Shade & Newman 2011, V-1).
///
///     StereoMatcher matcher(read_kitti_calibration("calib.txt"));
///     const StereoDepth seen = matcher.match("left.png", "right.png");
///     map.insert(depth_scan(seen.depth, matcher.camera(0.2), world_from_left).scan);
class StereoMatcher {
 public:
  /// Throws std::invalid_argument, which names the invalid field.
  explicit StereoMatcher(const StereoRig& rig, const StereoOptions& options = {});

  /// The rig that was passed to the constructor.
  [[nodiscard]] const StereoRig& rig() const { return rig_; }
  /// The options that were passed to the constructor, with the number of disparities that count.
  [[nodiscard]] const StereoOptions& options() const { return options_; }
  /// Matches two image files. Throws std::runtime_error, with the file and the reason, if an image cannot be read,
  /// the sizes differ from each other or from the rig, or the images are not rectified although the rig says so. The
  /// latter is tested on feature points: their median offset between rows must not exceed 1.5 pixels.
  [[nodiscard]] StereoDepth match(const std::filesystem::path& left, const std::filesystem::path& right) const;
  /// The left camera as a depth camera for maps with cells of `cell_m`. Its range ends where the standard deviation
  /// of the depth exceeds one cell, so a surface lands in the right cell or the next one. Throws
  /// std::invalid_argument unless `cell_m` is > 0.
  [[nodiscard]] DepthCamera camera(double cell_m, double max_range_m = 40.0) const;

 private:
  StereoRig rig_;
  StereoOptions options_;
};

}  // namespace vantage
