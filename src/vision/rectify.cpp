// SPDX-License-Identifier: MIT
#include "vision/rectify.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace vantage::detail {
namespace {

struct Turned {
  cv::Mat r1, r2, p1, p2;
};

cv::Mat mat_of(const Eigen::Matrix3d& m) {
  return (cv::Mat_<double>(3, 3) << m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2));
}

Turned turned(const Rectification& given, cv::Size size) {
  const Eigen::Vector3d t = given.right_from_left.translation();
  Turned result;
  cv::Mat q;
  cv::stereoRectify(mat_of(given.left.k), given.left.distortion, mat_of(given.right.k), given.right.distortion, size,
                    mat_of(given.right_from_left.linear()), cv::Mat(cv::Vec3d(t.x(), t.y(), t.z())), result.r1,
                    result.r2, result.p1, result.p2, q, cv::CALIB_ZERO_DISPARITY, 0.0, size);
  return result;
}

cv::Mat undistorted(const LensModel& lens, const cv::Mat& turn, const cv::Mat& projection, const cv::Mat& image) {
  cv::Mat x;
  cv::Mat y;
  cv::initUndistortRectifyMap(mat_of(lens.k), lens.distortion, turn, projection, image.size(), CV_32FC1, x, y);
  cv::Mat result;
  cv::remap(image, result, x, y, cv::INTER_LINEAR);
  return result;
}

}  // namespace

StereoRig rig_after(const Rectification& rectification, std::size_t width, std::size_t height) {
  const Turned turn = turned(rectification, cv::Size(static_cast<int>(width), static_cast<int>(height)));
  StereoRig rig{.width = width, .height = height};
  rig.focal_px = turn.p1.at<double>(0, 0);
  rig.cx = turn.p1.at<double>(0, 2);
  rig.cy = turn.p1.at<double>(1, 2);
  rig.baseline_m = -turn.p2.at<double>(0, 3) / rig.focal_px;
  rig.offset_px = turn.p2.at<double>(0, 2) - rig.cx;
  rig.rectification = rectification;
  return rig;
}

std::pair<cv::Mat, cv::Mat> rectify(const StereoRig& rig, const cv::Mat& left, const cv::Mat& right) {
  const Turned turn = turned(*rig.rectification, left.size());
  return {undistorted(rig.rectification->left, turn.r1, turn.p1, left),
          undistorted(rig.rectification->right, turn.r2, turn.p2, right)};
}

// Selects well-textured corners distributed over the image, and searches each in a wide strip of the other image.
double rows_apart_px(const cv::Mat& left, const cv::Mat& right) {
  constexpr int kHalf = 10;
  constexpr int kAcross = 12;
  constexpr int kAlong = 160;
  constexpr double kGood = 0.9;
  constexpr std::size_t kFewest = 20;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(left, corners, 150, 0.01, 20.0);
  std::vector<double> off;
  for (const cv::Point2f& corner : corners) {
    const cv::Rect window(static_cast<int>(corner.x) - kHalf, static_cast<int>(corner.y) - kHalf, 2 * kHalf + 1,
                          2 * kHalf + 1);
    const cv::Rect all(0, 0, left.cols, left.rows);
    const cv::Rect strip =
        cv::Rect(window.x - kAlong, window.y - kAcross, window.width + kAlong + 20, window.height + 2 * kAcross) &
        all;
    if ((window & all) != window || strip.height < window.height || strip.width < 2 * window.width) {
      continue;
    }
    cv::Mat score;
    cv::matchTemplate(right(strip), left(window), score, cv::TM_CCOEFF_NORMED);
    double best = 0.0;
    cv::Point at;
    cv::minMaxLoc(score, nullptr, &best, nullptr, &at);
    if (best >= kGood) {
      off.push_back(std::abs(strip.y + at.y - window.y));
    }
  }
  if (off.size() < kFewest) {
    return 0.0;
  }
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  return *middle;
}

}  // namespace vantage::detail
