// SPDX-License-Identifier: MIT
#include "vision/image_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/depth_files.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

class ImageFile : public testing::Test {
 protected:
  [[nodiscard]] std::string complaint(const std::string& bytes) const {
    test::write_text(folder_ / "image", bytes);
    const std::string said = test::message_of<std::runtime_error>(
        [&] { (void)detail::read_image(folder_ / "image", detail::ImageKind::Colour8); });
    const std::string named = (folder_ / "image").string() + ": ";
    EXPECT_TRUE(said.empty() || said.rfind(named, 0) == 0) << said;
    return said.empty() ? said : said.substr(named.size());
  }
  [[nodiscard]] std::string encoded(const std::string& ending) const {
    const std::filesystem::path file = folder_ / ("encoded" + ending);
    const int type = ending == ".pgm" ? CV_8UC1 : CV_8UC3;
    cv::imwrite(file.string(), cv::Mat(48, 64, type, cv::Scalar(40, 90, 200)));
    return test::bytes_in(file);
  }
  test::TemporaryFolder folder_;
};

TEST_F(ImageFile, IsReadInThreeFormats) {
  for (const char* ending : {".png", ".jpg", ".ppm", ".pgm"}) {
    EXPECT_EQ(complaint(encoded(ending)), "") << ending;
  }
  EXPECT_NE(complaint("GIF89a"), "");
  EXPECT_NE(complaint(encoded(".bmp")), "");
}

// A header with an absurd number of pixels is rejected before memory is allocated.
TEST_F(ImageFile, HasABoundedSize) {
  EXPECT_NE(complaint("P6 100000 100000 255\n").find("is an image of 100000 x 100000 pixels, must be 1 to 67108864"),
            std::string::npos);
  EXPECT_NE(complaint("P5\n# a comment\n0 5 255\n").find("is an image of 0 x 5 pixels"), std::string::npos);
  std::string jpeg = encoded(".jpg");
  const std::size_t frame = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_NE(complaint(jpeg).find("is an image of 65535 x 65535 pixels"), std::string::npos) << complaint(jpeg);
}

TEST_F(ImageFile, CutOffIsAnError) {
  std::size_t cuts = 0;
  for (const char* ending : {".png", ".jpg"}) {
    const std::string whole = encoded(ending);
    for (std::size_t length = 0; length + 2 < whole.size(); ++length, ++cuts) {
      EXPECT_NE(complaint(whole.substr(0, length)), "") << ending << ", " << length << " of " << whole.size();
    }
  }
  EXPECT_GT(cuts, 300U);
}

}  // namespace
}  // namespace vantage
