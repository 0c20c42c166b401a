// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/geometry/pose.hpp>
#include <vector>

namespace vantage::detail {

/// The numbers of a text, between blanks, tabs, commas and line ends; none if something else is among them. "nan" and
/// "inf" are numbers here.
[[nodiscard]] std::optional<std::vector<double>> numbers_in(std::string_view text);

/// All lines of a text file but empty ones and those that begin with '#', each with its number in the file. Throws
/// std::runtime_error if it cannot be opened.
struct TextLine {
  std::size_t number = 0;
  std::string text;
};
[[nodiscard]] std::vector<TextLine> lines_of(const std::filesystem::path& file);

/// The rigid transform that rows of 3 x 4 or 4 x 4 numbers give, freed from what rounding has done to it. None if one
/// is not finite or the linear part is not within 0.01 of a rotation.
[[nodiscard]] std::optional<Pose> pose_of_rows(const std::vector<double>& rows);

/// The transform of a translation and a quaternion x, y, z, w, which is normalised. None if one of the numbers is not
/// finite or the quaternion is (nearly) zero. `was_off` tells whether its length was off 1 by more than 0.001.
[[nodiscard]] std::optional<Pose> pose_of_quaternion(const Eigen::Matrix<double, 7, 1>& numbers, bool& was_off);

/// From the axes of a level camera (x right, y down, z forward), which some recordings take for their world, to axes
/// with +z up: x forward, y left.
[[nodiscard]] Pose upright_from_camera_axes();

}  // namespace vantage::detail
