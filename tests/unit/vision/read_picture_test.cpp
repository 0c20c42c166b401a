// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <stdexcept>
#include <vantage/vision/read_picture.hpp>

#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

TEST(Picture, ComesBackFromItsFile) {
  const test::TemporaryFolder folder;
  const Picture picture{2, 2, {200, 0, 0, 0, 200, 0, 0, 0, 200, 1, 2, 3}};
  write_png(picture, folder / "picture.png");
  const Picture read = read_picture(folder / "picture.png");
  EXPECT_EQ(read.width, 2U);
  EXPECT_EQ(read.height, 2U);
  EXPECT_EQ(read.rgb, picture.rgb);
  EXPECT_THROW((void)read_picture(folder / "none.png"), std::runtime_error);
}

}  // namespace
}  // namespace vantage
