// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace vantage::fuzz {

/// A temporary folder with the files of an input: a line `@@ NAME` begins each. Names may hold a folder, but only of
/// letters, digits and `._-`. Deleted by the destructor.
class InputFolder {
 public:
  explicit InputFolder(std::string_view files)
      : path_(std::filesystem::temp_directory_path() / ("vantage-fuzz-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
    while (!files.empty()) {
      const std::string_view file = files.substr(0, std::min(files.find("@@ ", 1), files.size()));
      files.remove_prefix(file.size());
      const std::size_t end = file.find('\n');
      if (file.starts_with("@@ ") && end != std::string_view::npos) {
        write(std::string(file.substr(3, end - 3)), file.substr(end + 1));
      }
    }
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder(InputFolder&&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;
  InputFolder& operator=(InputFolder&&) = delete;
  ~InputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  void write(const std::string& name, std::string_view content) {
    constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789._-/";
    if (name.empty() || name.size() > 60 || name.find_first_not_of(kAllowed) != std::string::npos ||
        name.find("..") != std::string::npos || name.front() == '/') {
      return;
    }
    std::error_code ignored;
    std::filesystem::create_directories((path_ / name).parent_path(), ignored);
    std::ofstream(path_ / name, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }

  std::filesystem::path path_;
};

}  // namespace vantage::fuzz
