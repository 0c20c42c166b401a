// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <utility>
#include <vantage/vision/stereo_rig.hpp>

namespace vantage::detail {

/// The rectified rig for images of width x height.
[[nodiscard]] StereoRig rig_after(const Rectification& rectification, std::size_t width, std::size_t height);

/// Rectifies a pair of images. `rig` must have a rectification.
[[nodiscard]] std::pair<cv::Mat, cv::Mat> rectify(const StereoRig& rig, const cv::Mat& left, const cv::Mat& right);

/// The median vertical offset of matched feature points, pixels; 0 if too few are found.
[[nodiscard]] double rows_apart_px(const cv::Mat& left, const cv::Mat& right);

}  // namespace vantage::detail
