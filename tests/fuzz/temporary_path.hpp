// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace vantage::fuzz {

/// A path of this process in the folder for temporary files. What lies there is deleted by the destructor.
class TemporaryPath {
 public:
  explicit TemporaryPath(const std::string& ending)
      : path_(std::filesystem::temp_directory_path() / ("vantage-fuzz-" + std::to_string(::getpid()) + ending)) {}
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath(TemporaryPath&&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;
  TemporaryPath& operator=(TemporaryPath&&) = delete;
  ~TemporaryPath() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace vantage::fuzz
