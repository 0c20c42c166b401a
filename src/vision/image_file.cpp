// SPDX-License-Identifier: MIT
#include "vision/image_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace vantage::detail {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::array<unsigned char, 8> kPngStart{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

Bytes bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) {
    refuse(file, "cannot be opened");
  }
  Bytes bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.empty()) {
    refuse(file, "is empty");
  }
  return bytes;
}

std::uint32_t number_at(const Bytes& bytes, std::size_t at) {
  return (std::uint32_t{bytes[at]} << 24U) | (std::uint32_t{bytes[at + 1]} << 16U) |
         (std::uint32_t{bytes[at + 2]} << 8U) | bytes[at + 3];
}

// CRC-32 as PNG has it (ISO 3309).
std::uint32_t check_sum(const unsigned char* from, const unsigned char* to) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value & 1U) != 0U ? 0xEDB88320U ^ (value >> 1U) : value >> 1U;
      }
      made[i] = value;
    }
    return made;
  }();
  std::uint32_t sum = 0xFFFFFFFFU;
  for (; from != to; ++from) {
    sum = table[(sum ^ *from) & 0xFFU] ^ (sum >> 8U);
  }
  return ~sum;
}

bool is_png(const Bytes& bytes) {
  return bytes.size() >= kPngStart.size() && std::equal(kPngStart.begin(), kPngStart.end(), bytes.begin());
}

// Chunks: length, name of four letters, content, check sum of name and content; the last one is IEND.
void check_png(const std::filesystem::path& file, const Bytes& bytes) {
  constexpr std::size_t kAroundContent = 12;
  std::size_t at = kPngStart.size();
  for (;;) {
    if (bytes.size() - at < kAroundContent) {
      refuse(file, "is a PNG file that was cut off after " + std::to_string(bytes.size()) + " bytes");
    }
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - kAroundContent) {
      refuse(file, "is a PNG file that was cut off after " + std::to_string(bytes.size()) + " bytes");
    }
    const unsigned char* name = bytes.data() + at + 4;
    if (check_sum(name, name + 4 + length) != number_at(bytes, at + 8 + length)) {
      refuse(file, "is a damaged PNG file: a check sum is wrong at byte " + std::to_string(at));
    }
    if (std::equal(name, name + 4, "IEND")) {
      return;
    }
    at += kAroundContent + length;
  }
}

// Bits per channel and kind of colour stand at fixed places of the first chunk.
void check_depth_png(const std::filesystem::path& file, const Bytes& bytes) {
  constexpr std::size_t kBits = 24;
  constexpr std::size_t kColourKind = 25;
  if (bytes.size() <= kColourKind) {
    refuse(file, "is a PNG file that was cut off after " + std::to_string(bytes.size()) + " bytes");
  }
  if (bytes[kColourKind] != 0) {
    refuse(file, "is a PNG file in colour; depth must be one channel of 16 bits");
  }
  if (bytes[kBits] != 16) {
    refuse(file, "is a PNG file of " + std::to_string(bytes[kBits]) + " bits; depth must be one channel of 16 bits");
  }
}

int flags_of(ImageKind kind) {
  switch (kind) {
    case ImageKind::Depth16:
      return cv::IMREAD_ANYDEPTH | cv::IMREAD_GRAYSCALE;
    case ImageKind::Grey8:
      return cv::IMREAD_GRAYSCALE;
    case ImageKind::Colour8:
      break;
  }
  return cv::IMREAD_COLOR;
}

}  // namespace

cv::Mat read_image(const std::filesystem::path& file, ImageKind kind) {
  const Bytes bytes = bytes_of(file);
  if (is_png(bytes)) {
    check_png(file, bytes);
  }
  if (kind == ImageKind::Depth16) {
    if (!is_png(bytes)) {
      refuse(file, "is not a PNG file; depth must be one, of one channel of 16 bits");
    }
    check_depth_png(file, bytes);
  }
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, flags_of(kind));
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) {
    refuse(file, "is not an image that can be read");
  }
  return image;
}

}  // namespace vantage::detail
