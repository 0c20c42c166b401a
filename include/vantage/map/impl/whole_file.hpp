// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

// Header-only, because every component writes files with it and exports no symbols for it.
namespace vantage::detail {

// Where the bytes of a file are written.
struct WritePlace {
  std::filesystem::path opened;
  std::filesystem::path renamed;  // final name; empty if the file is written in place
};

// Follows symbolic links, so that they are kept, also to a file that is not there yet.
inline WritePlace write_place_of(const std::filesystem::path& path) {
  constexpr int kMostLinks = 40;  // as many as the system follows
  std::error_code none;
  std::filesystem::path target = path;
  for (int links = 0; links < kMostLinks && std::filesystem::is_symlink(target, none); ++links) {
    target = target.parent_path() / std::filesystem::read_symlink(target, none);
  }
  if (std::filesystem::is_symlink(target, none) ||
      (std::filesystem::exists(target, none) && !std::filesystem::is_regular_file(target, none))) {
    return {target, {}};
  }
  return {std::filesystem::path(target) += ".part", target};
}

class WholeFile {
 public:
  WholeFile(const std::filesystem::path& named, WritePlace place)
      : named_(named),
        place_(std::move(place)),
        file_(::open(place_.opened.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOCTTY, 0666)) {
    if (file_ < 0) {
      fail();
    }
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile(WholeFile&&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  WholeFile& operator=(WholeFile&&) = delete;
  // Removes an unfinished file.
  ~WholeFile() {
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

/// Writes a file atomically: its name holds either all of `bytes` or the old content. The bytes are written to
/// NAME.part, which is then renamed. Devices and pipes are written in place. Throws std::runtime_error with the path
/// and the system's reason; NAME.part is then removed.
inline void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  WholeFile file(path, write_place_of(path));
  file.write(bytes);
  file.finish();
}

/// Tests whether a file could be written; throws as `write_whole_file`. Leaves no file behind.
inline void try_whole_file(const std::filesystem::path& path) { WholeFile(path, write_place_of(path)); }

}  // namespace vantage::detail
