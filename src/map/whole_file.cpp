// SPDX-License-Identifier: MIT
#include "map/whole_file.hpp"

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace vantage::detail {
namespace {

// Where the bytes of a file go first.
struct WritePlace {
  std::filesystem::path opened;
  std::filesystem::path renamed;  // empty: written to as it is
};

// A link is followed, so that it stays one.
WritePlace place_of(const std::filesystem::path& path) {
  std::error_code none;
  const bool is_link = std::filesystem::is_symlink(path, none);
  const std::filesystem::path target = is_link ? std::filesystem::weakly_canonical(path, none) : path;
  if (std::filesystem::exists(target, none) && !std::filesystem::is_regular_file(target, none)) {
    return {target, {}};
  }
  return {std::filesystem::path(target) += ".part", target};
}

class OpenFile {
 public:
  OpenFile(const std::filesystem::path& named, WritePlace place)
      : named_(named),
        place_(std::move(place)),
        file_(::open(place_.opened.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOCTTY, 0666)) {
    if (file_ < 0) {
      fail();
    }
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile(OpenFile&&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  OpenFile& operator=(OpenFile&&) = delete;
  // What was not finished goes.
  ~OpenFile() {
    if (file_ >= 0) {
      ::close(file_);
    }
    if (!finished_ && !place_.renamed.empty()) {
      ::unlink(place_.opened.c_str());
    }
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) {
        fail();
      }
      bytes.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
    }
  }
  void finish() {
    const int file = std::exchange(file_, -1);
    if (::close(file) != 0) {
      fail();
    }
    if (!place_.renamed.empty() && ::rename(place_.opened.c_str(), place_.renamed.c_str()) != 0) {
      fail();
    }
    finished_ = true;
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error(named_.string() + ": cannot be written: " + std::generic_category().message(errno));
  }

  const std::filesystem::path& named_;
  WritePlace place_;
  int file_;
  bool finished_ = false;
};

}  // namespace

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  OpenFile file(path, place_of(path));
  file.write(bytes);
  file.finish();
}

void try_whole_file(const std::filesystem::path& path) { OpenFile(path, place_of(path)); }

}  // namespace vantage::detail
