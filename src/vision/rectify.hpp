// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <utility>
#include <vantage/vision/stereo_rig.hpp>

namespace vantage::detail {

/// The rig whose images come out of rectification, for images of width x height.
[[nodiscard]] StereoRig rig_after(const Rectification& rectification, std::size_t width, std::size_t height);

/// Left and right image on common rows. `rig` has a rectification.
[[nodiscard]] std::pair<cv::Mat, cv::Mat> rectify(const StereoRig& rig, const cv::Mat& left, const cv::Mat& right);

/// Of points matched between two images, along and across the rows, the median distance off the row, pixels; 0 where
/// hardly any are found.
[[nodiscard]] double rows_apart_px(const cv::Mat& left, const cv::Mat& right);

}  // namespace vantage::detail
