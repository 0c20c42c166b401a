// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/geometry/pose.hpp>
#include <vector>

namespace vantage::detail {

/// Most bytes of a text file of a recording.
inline constexpr std::size_t kMostTextBytes = std::size_t{1} << 30U;

/// Parses numbers separated by blanks, tabs, commas or line ends. nullopt if the text contains anything else. "nan"
/// and "inf" count as numbers.
[[nodiscard]] std::optional<std::vector<double>> numbers_in(std::string_view text);

/// Reads all lines of a text file, with their numbers, except empty lines and lines that start with '#'. Throws
/// std::runtime_error if the file cannot be opened.
struct TextLine {
  std::size_t number = 0;
  std::string text;
};
[[nodiscard]] std::vector<TextLine> lines_of(const std::filesystem::path& file);

/// The rigid transform given by 3 x 4 or 4 x 4 numbers in row-major order, corrected for rounding. nullopt if a
/// number is not finite or the linear part is not within 0.01 of a rotation.
[[nodiscard]] std::optional<Pose> pose_of_rows(const std::vector<double>& rows);

/// The transform given by a translation and a quaternion x, y, z, w, which is normalised. nullopt if a number is not
/// finite or the quaternion is nearly zero. `was_off` is set to whether its length differed from 1 by more than
/// 0.001.
[[nodiscard]] std::optional<Pose> pose_of_quaternion(const Eigen::Matrix<double, 7, 1>& numbers, bool& was_off);

}  // namespace vantage::detail
