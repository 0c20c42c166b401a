// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vantage/vision/stereo_rig.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "vision/pose_text.hpp"
#include "vision/rectify.hpp"

namespace vantage {
namespace {

using detail::require_option;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

// Same as validate, but reports an error of the file.
StereoRig checked(const StereoRig& rig, const std::filesystem::path& file) {
  try {
    rig.validate();
  } catch (const std::invalid_argument& error) {
    refuse(file, error.what());
  }
  return rig;
}

cv::Mat matrix_in(const cv::FileStorage& storage, const char* name, int rows, int columns,
                  const std::filesystem::path& file) {
  cv::Mat matrix;
  storage[name] >> matrix;
  if (matrix.empty()) {
    refuse(file, std::string("there is no matrix '") + name + "'");
  }
  matrix.convertTo(matrix, CV_64F);
  const bool fits = rows > 0 ? matrix.rows == rows && matrix.cols == columns : matrix.total() >= 4;
  if (!fits || !cv::checkRange(matrix)) {
    refuse(file, std::string("the matrix '") + name + "' has a wrong size or a number that is not finite");
  }
  return matrix;
}

cv::FileStorage storage_of(const std::filesystem::path& file) {
  try {
    cv::FileStorage storage(file.string(), cv::FileStorage::READ);
    if (storage.isOpened()) {
      return storage;
    }
  } catch (const cv::Exception&) {  // replaced by a clearer message
    refuse(file, "is not a file of OpenCV matrices (YAML or XML)");
  }
  refuse(file, "cannot be opened");
}

LensModel lens_of(const cv::Mat& k, const cv::Mat& distortion) {
  LensModel lens;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      lens.k(row, column) = k.at<double>(row, column);
    }
  }
  lens.distortion.assign(distortion.begin<double>(), distortion.end<double>());
  return lens;
}

// OpenCV knows lenses of these numbers of coefficients; none: no distortion.
void check_lens(const LensModel& lens, const char* camera) {
  constexpr std::array<std::size_t, 6> kCounts{0, 4, 5, 8, 12, 14};
  const std::size_t count = lens.distortion.size();
  require_option(std::find(kCounts.begin(), kCounts.end(), count) != kCounts.end(),
                 std::string("count of Rectification::") + camera + ".distortion", count, "0, 4, 5, 8, 12 or 14");
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!lens.k.allFinite() || !std::all_of(lens.distortion.begin(), lens.distortion.end(), finite)) {
    throw std::invalid_argument(std::string("Rectification::") + camera + " has a number that is not finite");
  }
}

}  // namespace

double StereoRig::depth_m(double disparity_px) const {
  const double shift = disparity_px + offset_px;
  return shift > 0.0 ? focal_px * baseline_m / shift : std::numeric_limits<double>::infinity();
}

void StereoRig::validate() const {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  require_option(positive(focal_px), "StereoRig::focal_px", focal_px, "> 0");
  require_option(positive(baseline_m), "StereoRig::baseline_m", baseline_m, "> 0");
  require_option(std::isfinite(cx), "StereoRig::cx", cx, "finite");
  require_option(std::isfinite(cy), "StereoRig::cy", cy, "finite");
  require_option(std::isfinite(offset_px), "StereoRig::offset_px", offset_px, "finite");
  if (!rectification) {
    return;
  }
  check_lens(rectification->left, "left");
  check_lens(rectification->right, "right");
  if (!is_rigid(rectification->right_from_left)) {
    throw std::invalid_argument("Rectification::right_from_left is not a rigid transform");
  }
}

StereoRig read_kitti_calibration(const std::filesystem::path& file, std::size_t left) {
  std::map<std::size_t, std::vector<double>> rows;  // by the number of the camera
  for (const detail::TextLine& line : detail::lines_of(file)) {
    const std::size_t colon = line.text.find(':');
    const std::string_view text = line.text;
    const auto numbers = detail::numbers_in(colon == std::string::npos ? text : text.substr(colon + 1));
    if (!numbers || numbers->size() != 12) {
      refuse(file, "line " + std::to_string(line.number) + " is not a projection matrix of 12 numbers");
    }
    const auto label = colon == std::string::npos || text.front() != 'P'
                           ? std::nullopt
                           : detail::numbers_in(text.substr(1, colon - 1));
    if (colon == std::string::npos) {
      rows.emplace(rows.size(), *numbers);
    } else if (label && label->size() == 1 && label->front() >= 0.0 && label->front() < 100.0) {
      rows.emplace(static_cast<std::size_t>(label->front()), *numbers);
    }  // else the place of another sensor
  }
  const auto l = rows.find(left);
  const auto r = rows.find(left + 1);
  if (l == rows.end() || r == rows.end()) {
    refuse(file, "has no projection matrices P" + std::to_string(left) + " and P" + std::to_string(left + 1));
  }
  StereoRig rig{.focal_px = l->second[0], .cx = l->second[2], .cy = l->second[6]};
  rig.baseline_m = (l->second[3] - r->second[3]) / rig.focal_px;  // the last column is -f b
  rig.offset_px = r->second[2] - l->second[2];
  return checked(rig, file);
}

StereoRig read_middlebury_calibration(const std::filesystem::path& file) {
  std::map<std::string, std::vector<double>, std::less<>> values;
  for (const detail::TextLine& line : detail::lines_of(file)) {
    const std::size_t equals = line.text.find('=');
    std::string text = equals == std::string::npos ? "" : line.text.substr(equals + 1);
    for (char& c : text) {
      c = c == '[' || c == ']' || c == ';' ? ' ' : c;
    }
    const auto numbers = detail::numbers_in(text);
    if (equals == std::string::npos || !numbers) {
      refuse(file, "line " + std::to_string(line.number) + " is not key=value with numbers");
    }
    values[line.text.substr(0, equals)] = *numbers;
  }
  const auto value = [&](const char* name, std::size_t size, std::size_t index) {
    const auto found = values.find(name);
    if (found == values.end() || found->second.size() != size) {
      refuse(file, std::string("there is no '") + name + "' of " + std::to_string(size) + " numbers");
    }
    return found->second[index];
  };
  const auto pixels = [&](const char* name) {
    constexpr double kMost = 1U << 26U;
    const double count = value(name, 1, 0);
    if (!(count >= 0.0 && count <= kMost && count == std::floor(count))) {  // false for NaN
      refuse(file, std::string("'") + name + "' is no number of pixels");
    }
    return static_cast<std::size_t>(count);
  };
  StereoRig rig;
  rig.width = pixels("width");
  rig.height = pixels("height");
  if (values.contains("cam0")) {
    rig.focal_px = value("cam0", 9, 0);
    rig.cx = value("cam0", 9, 2);
    rig.cy = value("cam0", 9, 5);
    rig.offset_px = value("doffs", 1, 0);
    rig.baseline_m = value("baseline", 1, 0) / 1000.0;
  } else {
    rig.focal_px = value("focal_px", 1, 0);
    rig.cx = value("cx_left", 1, 0);
    rig.cy = value("cy", 1, 0);
    rig.offset_px = value("doffs_px", 1, 0);
    rig.baseline_m = value("baseline_m", 1, 0);
  }
  return checked(rig, file);
}

StereoRig read_opencv_calibration(const std::filesystem::path& intrinsics, const std::filesystem::path& extrinsics,
                                  std::size_t width, std::size_t height, double unit_m) {
  require_option(std::isfinite(unit_m) && unit_m > 0.0, "unit_m", unit_m, "> 0");
  constexpr std::size_t kMostPixels = std::size_t{1} << 26U;
  require_option(width > 0 && width <= kMostPixels, "width", width, "in [1, 67108864]");
  require_option(height > 0 && height <= kMostPixels, "height", height, "in [1, 67108864]");
  const cv::FileStorage lenses = storage_of(intrinsics);
  Rectification rectification;
  rectification.left = lens_of(matrix_in(lenses, "M1", 3, 3, intrinsics), matrix_in(lenses, "D1", 0, 0, intrinsics));
  rectification.right = lens_of(matrix_in(lenses, "M2", 3, 3, intrinsics), matrix_in(lenses, "D2", 0, 0, intrinsics));
  const cv::FileStorage placement = storage_of(extrinsics);
  const cv::Mat r = matrix_in(placement, "R", 3, 3, extrinsics);
  const cv::Mat t = matrix_in(placement, "T", 3, 1, extrinsics);
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row) {
    rows.insert(rows.end(), r.ptr<double>(row), r.ptr<double>(row) + 3);
    rows.push_back(t.at<double>(row) * unit_m);
  }
  const std::optional<Pose> pose = detail::pose_of_rows(rows);
  if (!pose) {
    refuse(extrinsics, "R and T are not a rigid transform");
  }
  rectification.right_from_left = *pose;
  try {
    return checked(detail::rig_after(rectification, width, height), extrinsics);
  } catch (const cv::Exception& error) {
    refuse(intrinsics, "OpenCV cannot rectify this pair with R and T of " + extrinsics.string() + ": " + error.err);
  }
}

}  // namespace vantage
