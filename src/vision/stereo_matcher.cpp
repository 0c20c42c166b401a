// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vantage/vision/stereo_matcher.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "vision/image_file.hpp"
#include "vision/rectify.hpp"

namespace vantage {
namespace {

using detail::require_option;

constexpr int kSubpixel = 16;  // OpenCV stores disparities in sixteenths of a pixel
constexpr std::int16_t kNone = std::numeric_limits<std::int16_t>::min();

void check(const StereoOptions& options) {
  require_option(std::abs(options.least_disparity_px) <= 1024, "StereoOptions::least_disparity_px",
                 options.least_disparity_px, "in [-1024, 1024]");
  require_option(options.disparities_px >= 0 && options.disparities_px % 16 == 0 && options.disparities_px <= 1024,
                 "StereoOptions::disparities_px", options.disparities_px, "a multiple of 16 in [16, 1024], or 0");
  require_option(options.window_px > 0 && options.window_px % 2 == 1 && options.window_px <= 255,
                 "StereoOptions::window_px", options.window_px, "odd, in [1, 255]");
  require_option(options.uniqueness_percent >= 0 && options.uniqueness_percent <= 100,
                 "StereoOptions::uniqueness_percent", options.uniqueness_percent, "in [0, 100]");
  require_option(options.speckle_pixels >= 0, "StereoOptions::speckle_pixels", options.speckle_pixels, ">= 0");
  require_option(std::isfinite(options.speckle_step_px) && options.speckle_step_px >= 0.0,
                 "StereoOptions::speckle_step_px", options.speckle_step_px, ">= 0");
  require_option(std::isfinite(options.least_texture) && options.least_texture >= 0.0, "StereoOptions::least_texture",
                 options.least_texture, ">= 0");
  require_option(std::isfinite(options.sigma_d_px) && options.sigma_d_px > 0.0, "StereoOptions::sigma_d_px",
                 options.sigma_d_px, "> 0");
}

// Enough disparities for a surface so many baselines away.
int disparities_for(const StereoRig& rig, int least_disparity_px) {
  constexpr double kNearestBaselines = 4.0;
  const double most_px = rig.focal_px / kNearestBaselines - rig.offset_px - least_disparity_px;
  return static_cast<int>(16.0 * std::clamp(std::ceil(most_px / 16.0), 1.0, 64.0));
}

cv::Ptr<cv::StereoMatcher> matcher_of(const StereoOptions& options) {
  if (options.method == StereoMethod::Block) {
    const auto block = cv::StereoBM::create(options.disparities_px, std::max(5, options.window_px));
    block->setMinDisparity(options.least_disparity_px);
    block->setUniquenessRatio(options.uniqueness_percent);
    block->setDisp12MaxDiff(options.left_right_px);
    block->setTextureThreshold(0);  // replaced by least_texture, which works for both methods
    return block;
  }
  const int area = options.window_px * options.window_px;
  return cv::StereoSGBM::create(options.least_disparity_px, options.disparities_px, options.window_px, 8 * area,
                                32 * area, options.left_right_px, 63, options.uniqueness_percent, 0, 0,
                                cv::StereoSGBM::MODE_SGBM);
}

// A surface nearer than the range is often matched inside of it, so at least `searched_px` disparities are searched,
// and what lies beyond the range is dropped. The matchers skip as many columns on the left as there are disparities.
// A border on the left avoids this.
cv::Mat disparities(const cv::Mat& left, const cv::Mat& right, const StereoOptions& options, int searched_px) {
  StereoOptions search = options;
  search.disparities_px = std::max(options.disparities_px, searched_px);
  const int border = std::max(0, search.least_disparity_px + search.disparities_px);
  cv::Mat wide_left;
  cv::Mat wide_right;
  cv::copyMakeBorder(left, wide_left, 0, 0, border, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(right, wide_right, 0, 0, border, 0, cv::BORDER_REPLICATE);
  cv::Mat wide;
  matcher_of(search)->compute(wide_left, wide_right, wide);
  cv::Mat result = wide.colRange(border, wide.cols).clone();
  const int first = options.least_disparity_px * kSubpixel;
  const int last = first + (options.disparities_px - 1) * kSubpixel;
  for (int row = 0; row < result.rows; ++row) {
    auto* values = result.ptr<std::int16_t>(row);
    for (int column = 0; column < result.cols; ++column) {
      const bool in_the_border = column * kSubpixel < values[column];
      if (values[column] <= first || values[column] >= last || in_the_border) {
        values[column] = kNone;
      }
    }
  }
  return result;
}

// Mean absolute horizontal brightness gradient in the window, grey values per pixel.
cv::Mat texture_of(const cv::Mat& image, int window_px) {
  cv::Mat slope;
  cv::filter2D(image, slope, CV_32F, cv::Mat(cv::Matx13f(-0.5F, 0.0F, 0.5F)));
  slope = cv::abs(slope);
  cv::Mat mean;
  cv::blur(slope, mean, cv::Size(window_px, window_px));
  return mean;
}

std::size_t count_matched(const cv::Mat& values) {
  return static_cast<std::size_t>(cv::countNonZero(values != kNone));
}

std::string size_of(const cv::Mat& image) {
  return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels";
}

// A side of a rig's images is 0 if it is not known.
bool may_be(int pixels, std::size_t of_rig) { return of_rig == 0 || static_cast<std::size_t>(pixels) == of_rig; }

std::string side_of(std::size_t of_rig) { return of_rig == 0 ? "any" : std::to_string(of_rig); }

void check_pair(const StereoRig& rig, const cv::Mat& left, const cv::Mat& right,
                const std::filesystem::path& left_file, const std::filesystem::path& right_file) {
  if (left.size() != right.size()) {
    throw std::runtime_error(right_file.string() + ": is " + size_of(right) + ", the left image is " + size_of(left));
  }
  if (!may_be(left.cols, rig.width) || !may_be(left.rows, rig.height)) {
    throw std::runtime_error(left_file.string() + ": is " + size_of(left) + ", the calibration is for " +
                             side_of(rig.width) + " x " + side_of(rig.height));
  }
  constexpr double kMostApart = 1.5;
  if (!rig.rectification) {
    const double apart_px = detail::rows_apart_px(left, right);
    if (apart_px > kMostApart) {
      throw std::runtime_error(right_file.string() + ": is not rectified: what it shows lies " +
                               std::to_string(static_cast<int>(apart_px)) + " rows off the left image");
    }
  }
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoRig& rig, const StereoOptions& options) : rig_(rig), options_(options) {
  rig.validate();
  check(options);
  if (options_.disparities_px == 0) {
    options_.disparities_px = disparities_for(rig_, options_.least_disparity_px);
  }
}

StereoDepth StereoMatcher::match(const std::filesystem::path& left_file,
                                 const std::filesystem::path& right_file) const {
  cv::Mat left = detail::read_image(left_file, detail::ImageKind::Grey8);
  cv::Mat right = detail::read_image(right_file, detail::ImageKind::Grey8);
  check_pair(rig_, left, right, left_file, right_file);
  if (rig_.rectification) {
    std::tie(left, right) = detail::rectify(rig_, left, right);
  }
  cv::Mat values = disparities(left, right, options_, disparities_for(rig_, options_.least_disparity_px));
  StereoDepth result;
  const std::size_t found = count_matched(values);
  result.report.unmatched = values.total() - found;
  if (options_.speckle_pixels > 0) {
    cv::filterSpeckles(values, kNone, options_.speckle_pixels, options_.speckle_step_px * kSubpixel);
    result.report.speckle = found - count_matched(values);
  }
  const cv::Mat texture = texture_of(left, options_.window_px);
  result.depth.width = static_cast<std::size_t>(left.cols);
  result.depth.height = static_cast<std::size_t>(left.rows);
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  for (int row = 0; row < values.rows; ++row) {
    for (int column = 0; column < values.cols; ++column) {
      const std::int16_t value = values.at<std::int16_t>(row, column);
      const bool plain = static_cast<double>(texture.at<float>(row, column)) < options_.least_texture;
      const double disparity_px = static_cast<double>(value) / kSubpixel;
      const double z_m = value == kNone || plain ? std::nan("") : rig_.depth_m(disparity_px);
      result.report.textureless += value != kNone && plain ? 1U : 0U;
      result.report.unmatched += std::isinf(z_m) ? 1U : 0U;
      result.report.matched += std::isfinite(z_m) ? 1U : 0U;
      result.disparity_px.push_back(std::isfinite(z_m) ? static_cast<float>(disparity_px) : kNothing);
      result.depth.z_m.push_back(std::isfinite(z_m) ? static_cast<float>(z_m) : kNothing);
    }
  }
  return result;
}

DepthCamera StereoMatcher::camera(double cell_m, double max_range_m) const {
  require_option(std::isfinite(cell_m) && cell_m > 0.0, "cell_m", cell_m, "> 0");
  DepthCamera camera{.width = rig_.width, .height = rig_.height, .fx = rig_.focal_px, .fy = rig_.focal_px};
  camera.cx = rig_.cx;
  camera.cy = rig_.cy;
  camera.max_range_m = max_range_m;
  camera.noise.quadratic_per_m = rig_.sigma_m(1.0, options_.sigma_d_px);
  camera.max_sigma_m = cell_m;
  return camera;
}

}  // namespace vantage
