// SPDX-License-Identifier: MIT
#include "vision/image_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <vantage/map/impl/file_bytes.hpp>

namespace vantage::detail {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::array<unsigned char, 8> kPngStart{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

Bytes bytes_of(const std::filesystem::path& file) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 30U;
  const std::string text = detail::file_bytes(file, kMostBytes);
  Bytes bytes(text.begin(), text.end());
  if (bytes.empty()) {
    refuse(file, "is empty");
  }
  return bytes;
}

std::uint32_t number_at(const Bytes& bytes, std::size_t at) {
  return (std::uint32_t{bytes[at]} << 24U) | (std::uint32_t{bytes[at + 1]} << 16U) |
         (std::uint32_t{bytes[at + 2]} << 8U) | bytes[at + 3];
}

// CRC-32 of PNG (ISO 3309).
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

// Each chunk has a length, a name of four letters, content, and a checksum of name and content. The last is IEND.
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

// Bit depth and colour type have fixed positions in the first chunk.
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

struct PixelSize {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
};

// The size is in the first frame header (SOF). A truncated file has no end marker (EOI) after the start of the pixel
// data (SOS).
std::optional<PixelSize> jpeg_size(const Bytes& bytes) {
  const auto short_at = [&](std::size_t at) { return std::uint64_t{bytes[at]} << 8U | bytes[at + 1]; };
  constexpr std::size_t kFrameHeader = 9;  // bytes from the marker to the end of the width
  std::optional<PixelSize> size;
  for (std::size_t at = 2; at + kFrameHeader <= bytes.size() && bytes[at] == 0xFF;) {
    const unsigned char marker = bytes[at + 1];
    if (marker == 0xFF) {  // padding
      ++at;
      continue;
    }
    const bool is_frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame && !size) {
      size = PixelSize{short_at(at + 7), short_at(at + 5)};
    }
    if (marker == 0xDA) {
      constexpr std::array<unsigned char, 2> kEnd{0xFF, 0xD9};
      const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
      return std::search(from, bytes.end(), kEnd.begin(), kEnd.end()) == bytes.end() ? std::nullopt : size;
    }
    at += 2 + short_at(at + 2);
  }
  return std::nullopt;
}

// Reads a header such as "P5 width height ...", which may contain comments.
std::optional<PixelSize> pnm_size(const Bytes& bytes) {
  std::istringstream in(
      std::string(bytes.begin() + 2, bytes.begin() + std::min<std::ptrdiff_t>(4096, std::ssize(bytes))));
  const auto number = [&]() -> std::optional<std::uint64_t> {
    while ((in >> std::ws) && in.peek() == '#') {
      in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    std::uint64_t value = 0;
    return std::isdigit(in.peek()) != 0 && in >> value ? std::optional(value) : std::nullopt;
  };
  const auto width = number();
  const auto height = number();
  return width && height ? std::optional(PixelSize{*width, *height}) : std::nullopt;
}

// Image size from the header; nullopt if it is not a complete PNG, JPEG or PNM.
std::optional<PixelSize> size_of(const Bytes& bytes) {
  constexpr std::size_t kPngHeader = 24;  // bytes up to the end of the height
  if (is_png(bytes)) {
    return bytes.size() < kPngHeader ? std::nullopt
                                     : std::optional(PixelSize{number_at(bytes, 16), number_at(bytes, 20)});
  }
  if (bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8) {
    return jpeg_size(bytes);
  }
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' ? pnm_size(bytes) : std::nullopt;
}

// Checked before memory for the pixels is allocated.
void check_size(const std::filesystem::path& file, const Bytes& bytes) {
  constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26U;  // 8192 x 8192
  const std::optional<PixelSize> size = size_of(bytes);
  if (!size) {
    refuse(file, "is not an image that can be read: no whole PNG, JPEG or PNM");
  }
  if (size->width == 0 || size->height == 0 || size->width > kMostPixels / size->height) {
    refuse(file, "is an image of " + std::to_string(size->width) + " x " + std::to_string(size->height) +
                     " pixels, must be 1 to " + std::to_string(kMostPixels));
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
  check_size(file, bytes);
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
