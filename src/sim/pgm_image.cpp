// SPDX-License-Identifier: MIT
#include "sim/pgm_image.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>

namespace vantage::detail {
namespace {

constexpr std::uint32_t kMostAlong = 1U << 24U;  // pixels along one side
constexpr std::uint32_t kMostGrey = 65535;

class PgmReader {
 public:
  explicit PgmReader(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
      refuse("there is no such file");
    }
    std::ifstream in(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    if (!in && bytes_.empty()) {
      refuse("cannot be read");
    }
  }

  PgmImage read() {
    if (bytes_.starts_with("\x89PNG")) {
      refuse("is a PNG file; maps are read as PGM (convert map.png map.pgm)");
    }
    const bool plain = bytes_.starts_with("P2");
    if (!plain && !bytes_.starts_with("P5")) {
      refuse("is not a PGM file: it begins with neither P2 nor P5");
    }
    at_ = 2;
    PgmImage image;
    image.width = static_cast<std::int32_t>(number("its width", kMostAlong));
    image.height = static_cast<std::int32_t>(number("its height", kMostAlong));
    const std::uint32_t brightest = number("its brightest value", kMostGrey);
    if (image.width == 0 || image.height == 0 || brightest == 0) {
      refuse("has no pixels, or 0 for its brightest value");
    }
    image.brightest = brightest;
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const std::size_t bytes_each =
        plain || brightest > 255 ? 2 : 1;  // a plain pixel has at least a digit and a blank
    if (!plain) {
      ++at_;  // one blank separates the header from the pixels
    }
    if (bytes_.size() + (plain ? 1 : 0) < at_ || pixels > (bytes_.size() + (plain ? 1 : 0) - at_) / bytes_each) {
      refuse("is cut off: it has fewer than the " + std::to_string(image.width) + " x " +
             std::to_string(image.height) + " pixels that it tells of");
    }
    image.values.reserve(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::uint32_t value = plain ? number("a pixel", kMostGrey) : binary(bytes_each);
      if (value > brightest) {
        refuse("has a pixel of " + std::to_string(value) + ", brighter than its brightest value of " +
               std::to_string(brightest));
      }
      image.values.push_back(static_cast<std::uint16_t>(value));
    }
    return image;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw std::runtime_error(path_.string() + ": " + what); }

  std::uint32_t byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }

  std::uint32_t binary(std::size_t bytes_each) {
    const std::uint32_t value = bytes_each == 1 ? byte(at_) : (byte(at_) << 8U) | byte(at_ + 1);
    at_ += bytes_each;
    return value;
  }

  // Reads the next number in digits, after blanks and comments.
  std::uint32_t number(const char* what, std::uint32_t most) {
    while (at_ < bytes_.size() && (std::isspace(static_cast<int>(byte(at_))) != 0 || bytes_[at_] == '#')) {
      at_ = bytes_[at_] == '#' ? std::min(bytes_.find('\n', at_), bytes_.size()) : at_ + 1;
    }
    std::uint32_t value = 0;
    const std::size_t first = at_;
    for (; at_ < bytes_.size() && std::isdigit(static_cast<int>(byte(at_))) != 0; ++at_) {
      value = value * 10 + (byte(at_) - '0');
      if (value > most) {
        refuse(std::string(what) + " is larger than " + std::to_string(most));
      }
    }
    if (at_ == first) {
      refuse(std::string("has no number for ") + what + " at byte " + std::to_string(at_));
    }
    return value;
  }

  std::filesystem::path path_;
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

PgmImage read_pgm(const std::filesystem::path& path) { return PgmReader(path).read(); }

}  // namespace vantage::detail
