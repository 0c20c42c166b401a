// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace vantage::test {

/// Writes numbers as a PNG file with one channel of 16 bits.
inline void write_depth(const std::filesystem::path& file, int width, int height,
                        const std::vector<std::uint16_t>& numbers) {
  const cv::Mat image(height, width, CV_16UC1, const_cast<std::uint16_t*>(numbers.data()));
  cv::imwrite(file.string(), image);
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string bytes_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The message of the Error that a call throws, or "" if it does not throw.
template <class Error, class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace vantage::test
