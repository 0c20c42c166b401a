// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "temporary_path.hpp"

namespace vantage::fuzz {

/// A temporary folder with the files of an input: a line `@@ NAME` begins each. Names may hold a folder, but only of
/// letters, digits and `._-`.
class InputFolder : public TemporaryPath {
 public:
  explicit InputFolder(std::string_view files) : TemporaryPath("") {
    std::filesystem::create_directories(path());
    while (!files.empty()) {
      const std::string_view file = files.substr(0, std::min(files.find("@@ ", 1), files.size()));
      files.remove_prefix(file.size());
      const std::size_t end = file.find('\n');
      if (file.starts_with("@@ ") && end != std::string_view::npos) {
        write(std::string(file.substr(3, end - 3)), file.substr(end + 1));
      }
    }
  }

 private:
  void write(const std::string& name, std::string_view content) {
    constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789._-/";
    if (name.empty() || name.size() > 60 || name.find_first_not_of(kAllowed) != std::string::npos ||
        name.find("..") != std::string::npos || name.front() == '/') {
      return;
    }
    std::error_code ignored;
    std::filesystem::create_directories((path() / name).parent_path(), ignored);
    std::ofstream(path() / name, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
  }
};

}  // namespace vantage::fuzz
