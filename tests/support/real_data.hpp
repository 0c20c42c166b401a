// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>

namespace vantage::test {

/// Path of a file or folder below VANTAGE_DATA; empty if that is not set.
inline std::filesystem::path real_data(const std::filesystem::path& relative) {
  const char* root = std::getenv("VANTAGE_DATA");
  return root == nullptr || *root == '\0' ? std::filesystem::path() : std::filesystem::path(root) / relative;
}

}  // namespace vantage::test

/// Declares `variable`, a path below VANTAGE_DATA, or skips the test and says how to run it.
#define VANTAGE_REAL_DATA(variable, relative)                                                        \
  const std::filesystem::path variable = ::vantage::test::real_data(relative);                       \
  if (variable.empty()) {                                                                            \
    GTEST_SKIP() << "needs " << (relative) << ": set VANTAGE_DATA to the folder with the real data"; \
  }                                                                                                  \
  ASSERT_TRUE(std::filesystem::exists(variable)) << variable
