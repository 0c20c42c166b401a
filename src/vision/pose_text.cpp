// SPDX-License-Identifier: MIT
#include "vision/pose_text.hpp"

#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <vantage/map/impl/file_bytes.hpp>

namespace vantage::detail {

std::optional<std::vector<double>> numbers_in(std::string_view text) {
  constexpr std::string_view kBetween = " \t\r\n,";
  std::vector<double> numbers;
  for (;;) {
    const std::size_t start = text.find_first_not_of(kBetween);
    if (start == std::string_view::npos) {
      return numbers;
    }
    text.remove_prefix(start);
    const std::size_t length = std::min(text.find_first_of(kBetween), text.size());
    const char* from = text.data() + (text.front() == '+' ? 1 : 0);
    double number = 0.0;
    const auto [stopped, error] = std::from_chars(from, text.data() + length, number);
    if (error != std::errc{} || stopped != text.data() + length) {
      return std::nullopt;
    }
    numbers.push_back(number);
    text.remove_prefix(length);
  }
}

std::vector<TextLine> lines_of(const std::filesystem::path& file) {
  std::istringstream in(file_bytes(file, kMostTextBytes));
  std::vector<TextLine> lines;
  std::string text;
  for (std::size_t number = 1; std::getline(in, text); ++number) {
    const std::size_t start = text.find_first_not_of(" \t\r");
    if (start != std::string::npos && text[start] != '#') {
      lines.push_back({number, text});
    }
  }
  return lines;
}

std::optional<Pose> pose_of_rows(const std::vector<double>& rows) {
  if (rows.size() != 12 && rows.size() != 16) {
    return std::nullopt;
  }
  const Eigen::Matrix<double, 3, 4> given =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows.data());
  if (!given.allFinite()) {
    return std::nullopt;
  }
  const Eigen::Matrix3d turn = given.leftCols<3>();
  constexpr double kMostOff = 0.01;
  if (!(turn.transpose() * turn).isIdentity(kMostOff) || turn.determinant() < 0.0) {
    return std::nullopt;
  }
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(turn).normalized().toRotationMatrix();
  pose.translation() = given.col(3);
  return pose;
}

std::optional<Pose> pose_of_quaternion(const Eigen::Matrix<double, 7, 1>& numbers, bool& was_off) {
  const Eigen::Quaterniond turn(numbers[6], numbers[3], numbers[4], numbers[5]);
  constexpr double kShortest = 1e-3;
  constexpr double kOff = 1e-3;
  if (!numbers.allFinite() || turn.norm() < kShortest) {
    return std::nullopt;
  }
  was_off = std::abs(turn.norm() - 1.0) > kOff;
  return Eigen::Translation3d(numbers.head<3>()) * turn.normalized();
}

}  // namespace vantage::detail
