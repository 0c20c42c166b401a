// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vantage/sim/nav2_map_file.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

// Free, unknown by its grey value, occupied; two rows, the top one first.
const std::string kThreeByTwo = std::string("P5\n# CREATOR: map_saver 0.050 m/pix\n3 2\n255\n") + "\xFE\xCD" +
                                std::string(1, '\0') + std::string(1, '\0') + "\xFE\xFE";

const std::string kSaved =
    "image: room.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.5, 2, 0.5]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

class Nav2MapFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  // The error message for a map of these two files; "" if there is none.
  std::string refusal(const std::string& yaml, const std::string& image) {
    write("room.pgm", image);
    const std::filesystem::path path = write("room.yaml", yaml);
    try {
      (void)read_nav2_map(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), by);
}

std::string pixels_of(const GroundPlan& plan) {
  std::string drawn;
  for (const std::uint8_t solid : plan.solid.values()) {
    drawn += solid != 0 ? '#' : '.';
  }
  return drawn;
}

TEST_F(Nav2MapFile, IsReadFromTheLowestRowUp) {
  write("room.pgm", kThreeByTwo);
  const GroundPlan plan = read_nav2_map(write("room.yaml", kSaved));
  EXPECT_EQ(plan.solid.box(), (VoxelBox{{0, 0, 0}, {3, 2, 1}}));
  EXPECT_EQ(pixels_of(plan), "#...##");
  EXPECT_EQ(plan.pixel_m, 0.05);
  EXPECT_EQ(plan.x_m, -1.5);
  EXPECT_EQ(plan.y_m, 2.0);
  EXPECT_EQ(plan.yaw_rad, 0.5);
}

TEST_F(Nav2MapFile, EveryWayToWriteItSaysTheSame) {
  const std::string plain = "P2 3 2\n# rows\n10\n10 8 0\n0 10 10\n";
  std::string deep = "P5 3 2 1000\n";
  for (const int value : {1000, 800, 0, 0, 1000, 1000}) {
    deep += {static_cast<char>(value >> 8), static_cast<char>(value & 255)};
  }
  const std::string block =
      "%YAML 1.1\n---\n# a map\nimage: \"room.pgm\"   # beside\nresolution: 5.0e-2\norigin:\n- -1.5\n- +2.0\n- 0.5\n"
      "negate: false\noccupied_thresh: .65\nfree_thresh: 0.196\nextra: 'ignored: yes'\n...\n";
  const std::string flow = replaced(kSaved, "[-1.5, 2, 0.5]", "[-1.5,\n  2.0,\n  0.5]");
  std::string windows;
  for (const char c : kSaved) {
    windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  }
  std::size_t ways = 0;
  for (const std::string& yaml : {kSaved, "\xEF\xBB\xBF" + kSaved, block, flow, windows}) {
    for (const std::string& image : {kThreeByTwo, plain, deep}) {
      ASSERT_EQ(refusal(yaml, image), "") << yaml;
      const GroundPlan plan = read_nav2_map(folder_ / "room.yaml");
      EXPECT_EQ(pixels_of(plan), "#...##") << yaml;
      EXPECT_EQ(plan.pixel_m, 0.05);
      EXPECT_EQ(plan.x_m, -1.5);
      EXPECT_EQ(plan.y_m, 2.0);
      EXPECT_EQ(plan.yaw_rad, 0.5);
      ++ways;
    }
  }
  EXPECT_EQ(ways, 15U);
}

TEST_F(Nav2MapFile, NegateMakesBrightPixelsOccupied) {
  write("room.pgm", kThreeByTwo);
  EXPECT_EQ(pixels_of(read_nav2_map(write("room.yaml", replaced(kSaved, "negate: 0", "negate: 1")))), ".####.");
}

TEST_F(Nav2MapFile, IsAWorldByItsExtension) {
  write("room.pgm", kThreeByTwo);
  const World world = World::from_file(write("room.yaml", kSaved));
  ASSERT_TRUE(world.plan.has_value());
  EXPECT_EQ(world.name, "room.yaml");
  EXPECT_EQ(World::kind_of_file("a/B.YML"), World::FileKind::Plan);
  EXPECT_EQ(World::kind_of_file("house.OT"), World::FileKind::OctoMap);
  EXPECT_EQ(World::kind_of_file("house.ply"), World::FileKind::Mesh);
}

TEST_F(Nav2MapFile, SaysWhatIsWrongAndWhere) {
  const std::vector<std::pair<std::string, std::string>> of_yaml{
      {replaced(kSaved, "image: room.pgm\n", ""), "room.yaml: 'image' is missing"},
      {replaced(kSaved, "resolution: 0.05\n", ""), "room.yaml: 'resolution' is missing"},
      {replaced(kSaved, "0.05", "0"), "room.yaml: 'resolution' is 0, must be in ["},
      {replaced(kSaved, "0.05", "nan"), "room.yaml: 'resolution' holds 'nan', which is not a number"},
      {replaced(kSaved, "0.05", "0.05m"), "room.yaml: 'resolution' holds '0.05m', which is not a number"},
      {replaced(kSaved, ", 0.5]", "]"), "room.yaml: 'origin' must be 3 numbers, is 2"},
      {replaced(kSaved, "0.5]", "0.5"), "room.yaml: line"},
      {replaced(kSaved, "-1.5", "1e300"), "room.yaml: 'origin' is further than"},
      {replaced(kSaved, "negate: 0", "negate: maybe"), "room.yaml: 'negate' is 'maybe', must be 0 or 1"},
      {replaced(kSaved, "0.65", "0.1"), "room.yaml: 'free_thresh' is above 'occupied_thresh'"},
      {replaced(kSaved, "0.65", "65"), "room.yaml: 'occupied_thresh' is 65, must be in [0, 1]"},
      {replaced(kSaved, "trinary", "scale"), "room.yaml: 'mode' is 'scale', only trinary is read"},
      {replaced(kSaved, "negate: 0", "negate: 0\nnegate: 1"), "room.yaml: line 6: 'negate' stands there twice"},
      {replaced(kSaved, "negate: 0", "map:\n  negate: 0"), "room.yaml: line 6: 'negate: 0' is not 'key: value'"},
      {replaced(kSaved, "room.pgm", "{a: b}"), "room.yaml: line 1: '{a: b}' is more than a word"},
      {replaced(kSaved, "room.pgm", "'room.pgm"), "room.yaml: line 1: 'room.pgm is not a simple quoted text"},
      {replaced(kSaved, "room.pgm", "none.pgm"), "none.pgm: there is no such file"},
      {replaced(kSaved, "0.196", "0"), "room.yaml: no pixel of 'room.pgm' is free"},
      {"", "room.yaml: cannot be read, or is empty"}};
  for (const auto& [yaml, what] : of_yaml) {
    const std::string said = refusal(yaml, kThreeByTwo);
    EXPECT_NE(said.find((folder_ / what).string()), std::string::npos) << said << "\nfor " << what;
  }
  const std::vector<std::pair<std::string, std::string>> of_image{
      {"", "is not a PGM file"},
      {"P6 1 1 255\nabc", "is not a PGM file"},
      {"\x89PNG\r\n", "is a PNG file; maps are read as PGM"},
      {"P5 3 2", "has no number for its brightest value"},
      {"P5 0 2 255\n", "has no pixels"},
      {"P5 3 2 0\n", "has no pixels"},
      {"P5 99999999 2 255\n", "its width is larger than"},
      {"P5 16000000 16000000 255\n", "is cut off"},
      {"P5 3 2 70000\n", "its brightest value is larger than"},
      {kThreeByTwo.substr(0, kThreeByTwo.size() - 1), "is cut off: it has fewer than the 3 x 2 pixels"},
      {"P2 3 2 10\n1 2 3 4 5", "is cut off"},
      {"P2 3 2 10\n1 2 3 4 5 x", "has no number for a pixel at byte 20"},
      {"P2 3 2 10\n1 2 3 4 5 11", "has a pixel of 11, brighter than its brightest value of 10"}};
  for (const auto& [image, what] : of_image) {
    const std::string said = refusal(kSaved, image);
    EXPECT_NE(said.find((folder_ / "room.pgm").string() + ": " + what), std::string::npos)
        << said << "\nfor " << what;
  }
}

// Files truncated or changed anywhere give a map or the documented error.
TEST_F(Nav2MapFile, DamagedFilesAreReadOrRefused) {
  std::mt19937_64 engine(1);
  std::size_t refused = 0;
  constexpr std::size_t kFiles = 400;
  for (std::size_t i = 0; i < kFiles; ++i) {
    std::string yaml = kSaved;
    std::string image = kThreeByTwo;
    std::string& damaged = i % 2 == 0 ? yaml : image;
    if (engine() % 4 == 0) {
      damaged.resize(engine() % damaged.size());
    } else {
      damaged[engine() % damaged.size()] = static_cast<char>(engine());
    }
    refused += refusal(yaml, image).empty() ? 0U : 1U;
  }
  EXPECT_GT(refused, kFiles / 4);
  EXPECT_LT(refused, kFiles);
}

}  // namespace
}  // namespace vantage
