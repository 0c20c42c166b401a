// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vantage/picture/depth_picture.hpp>
#include <vector>

namespace vantage {
namespace {

TEST(DepthPicture, NearIsLightFarIsDarkAndNothingIsGrey) {
  const std::array<float, 6> depths_m{
      -1.0F, 0.0F, 2.0F, 9.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
  const Picture picture = draw_depth(depths_m, 3, 0.0, 2.0);
  EXPECT_EQ(picture.width, 3U);
  EXPECT_EQ(picture.height, 2U);
  EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{253, 231, 37, 253, 231, 37, 68, 1, 84,  //
                                                    68, 1, 84, 183, 189, 199, 183, 189, 199}));
}

TEST(DepthPicture, RefusesNoRowsAndNoRange) {
  const std::array<float, 6> depths_m{};
  EXPECT_THROW((void)draw_depth(depths_m, 3, 2.0, 2.0), std::invalid_argument);
  EXPECT_THROW((void)draw_depth(depths_m, 4, 0.0, 2.0), std::invalid_argument);
  EXPECT_THROW((void)draw_depth(depths_m, 0, 0.0, 2.0), std::invalid_argument);
  EXPECT_THROW((void)draw_depth({}, 3, 0.0, 2.0), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
