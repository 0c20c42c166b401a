// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vantage/picture/floor_plan.hpp>
#include <vantage/picture/void_picture.hpp>
#include <vector>

namespace vantage {
namespace {

OccupancyMap walled_room() {
  OccupancyMap map({.resolution_m = 0.1});
  for_each_cell(VoxelBox{{0, 0, 0}, {60, 40, 20}}, [&](const VoxelIndex& cell) {
    const bool wall = cell.x == 0 || cell.y == 0 || cell.x == 59 || cell.y == 39 || (cell.x == 30 && cell.y < 25);
    if (cell.x < 50 || wall) {
      map.set(cell, wall ? Occupancy::Occupied : Occupancy::Free);
    }
  });
  return map;
}

FloorPlanContent walk() {
  FloorPlanContent content;
  content.title = "walled room";
  content.travelled = {{1.0, 1.0, 1.0}, {1.5, 3.2, 1.0}, {4.2, 3.0, 1.0}};
  content.views = {pose_looking({1.0, 1.0, 1.0}, 0.0), pose_looking({1.5, 3.2, 1.0}, -1.0),
                   pose_looking({4.2, 3.0, 1.0}, 2.0)};
  return content;
}

// Number of pixels with approximately this colour.
std::size_t count(const Picture& picture, int red, int green, int blue) {
  std::size_t found = 0;
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    const auto near = [&](std::size_t channel, int value) {
      return std::abs(int(picture.rgb[i + channel]) - value) <= 6;
    };
    found += near(0, red) && near(1, green) && near(2, blue) ? 1U : 0U;
  }
  return found;
}

TEST(FloorPlan, ShowsFreeOccupiedUnknownAndTheJourney) {
  const Picture picture = draw_floor_plan(walled_room(), walk());
  ASSERT_EQ(picture.rgb.size(), 3 * picture.width * picture.height);
  const double area = 880.0 * 880.0 * 40.0 / 60.0;  // of the map, pixels
  EXPECT_NEAR(static_cast<double>(count(picture, 183, 189, 199)) / area, 9.0 * 38.0 / 2400.0, 0.02) << "unknown";
  EXPECT_NEAR(static_cast<double>(count(picture, 29, 32, 40)) / area, (2400.0 - 58.0 * 38.0 + 24.0) / 2400.0, 0.02)
      << "walls";
  EXPECT_GT(count(picture, 22, 145, 84), 100U) << "start";
  EXPECT_GT(count(picture, 206, 43, 55), 100U) << "end";
  EXPECT_EQ(picture.rgb, draw_floor_plan(walled_room(), walk()).rgb) << "the same input, the same bytes";
}

TEST(FloorPlan, ASliceShowsItsOwnHeightOnly) {
  OccupancyMap map = walled_room();
  map.set({10, 10, 15}, Occupancy::Occupied);
  FloorPlanContent content;
  content.slice_z_m = 0.55;
  const std::size_t low = count(draw_floor_plan(map, content), 29, 32, 40);
  content.slice_z_m = 1.55;
  const std::size_t high = count(draw_floor_plan(map, content), 29, 32, 40);
  EXPECT_GT(high, low);
}

TEST(FloorPlan, RefusesNothingToShow) {
  EXPECT_THROW((void)draw_floor_plan(OccupancyMap(), {}), std::invalid_argument);
  EXPECT_THROW((void)draw_voids(OccupancyMap(), {}), std::invalid_argument);
  EXPECT_THROW((void)draw_void_utility(OccupancyMap(), {}), std::invalid_argument);
}

TEST(FloorPlan, ManagesVeryLongAndVeryWideMaps) {
  OccupancyMap map({.resolution_m = 0.05});
  map.set({0, 0, 0}, Occupancy::Free);
  map.set({30000, 3, 0}, Occupancy::Occupied);
  const Picture picture = draw_floor_plan(map, {});
  EXPECT_LT(picture.width, 2000U);
  EXPECT_LT(picture.height, 2000U);
}

TEST(Picture, SideBySideAndBelowEachOther) {
  const Picture red{2, 2, {200, 0, 0, 200, 0, 0, 200, 0, 0, 200, 0, 0}};
  const Picture green{1, 4, {0, 200, 0, 0, 200, 0, 0, 200, 0, 0, 200, 0}};
  const Picture both = side_by_side(std::vector<Picture>{red, green}, 4);
  EXPECT_EQ(both.width, 5U);
  EXPECT_EQ(both.height, 4U);
  EXPECT_EQ(count(both, 200, 0, 0), 16U);
  EXPECT_EQ(count(both, 0, 200, 0), 4U);
  const Picture column = below_each_other(std::vector<Picture>{red, green}, 2);
  EXPECT_EQ(column.width, 2U);
  EXPECT_EQ(column.height, 2U + 8U);
  EXPECT_EQ(count(column, 0, 200, 0), 16U);
  EXPECT_THROW((void)below_each_other({}, 4), std::invalid_argument);
  EXPECT_THROW((void)side_by_side({}, 4), std::invalid_argument);
  EXPECT_THROW((void)side_by_side(std::vector<Picture>{red, Picture{}}, 4), std::invalid_argument);
  EXPECT_THROW((void)side_by_side(std::vector<Picture>{red}, 0), std::invalid_argument);
}

TEST(Png, WritesAFileOrSaysWhyNot) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("vantage_picture_" + std::to_string(::getpid()) + ".png");
  write_png(draw_floor_plan(walled_room(), walk()), file);
  std::string magic(4, '\0');
  std::ifstream(file, std::ios::binary).read(magic.data(), 4);
  EXPECT_EQ(magic, "\x89PNG");
  std::filesystem::remove(file);
  EXPECT_THROW(write_png(Picture{}, file), std::invalid_argument);
  EXPECT_THROW(write_png(Picture{1, 1, {0, 0, 0}}, "/nowhere/a.png"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(VoidPicture, ShowsVoidsFrontiersAndUtility) {
  const OccupancyMap map = walled_room();
  std::vector<VoxelIndex> voids;
  for_each_cell({{5, 5, 0}, {10, 12, 20}}, [&](const VoxelIndex& cell) { voids.push_back(cell); });
  std::vector<VoxelIndex> frontier;
  for_each_cell({{10, 5, 0}, {11, 12, 20}}, [&](const VoxelIndex& cell) { frontier.push_back(cell); });
  std::vector<VoxelIndex> places;
  std::vector<std::uint64_t> utility;
  for (std::int32_t x = 12; x < 25; ++x) {
    places.push_back({x, 8, 10});
    utility.push_back(static_cast<std::uint64_t>(100 * (25 - x)));
  }
  const std::vector<Ellipsoid> ellipsoids{{{0.75, 0.85, 1.0}, Eigen::Matrix3d::Identity(), {0.3, 0.4, 1.0}}};
  VoidContent content{.title = "voids", .voids = voids, .frontier = frontier, .ellipsoids = ellipsoids};
  content.places = places;
  content.utility = utility;
  content.sensor = pose_looking({2.0, 3.0, 1.0}, 0.5);
  content.view = pose_looking({1.5, 0.85, 1.0}, 3.1);
  const auto more = [&](const Picture& picture, auto&& is_such) {
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      pixels += is_such(picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]) ? 1U : 0U;
    }
    return pixels;
  };
  const auto violet = [](int r, int g, int b) { return b > r + 20 && r > g + 20; };
  const auto red = [](int r, int g, int b) { return r > g + 100 && r > b + 100; };
  const auto green = [](int r, int g, int b) { return g > r + 60 && g > b + 40; };
  const Picture found = draw_voids(map, content);
  EXPECT_GT(more(found, violet), 35U * 100U);
  EXPECT_GT(more(found, red), 7U * 100U);
  const Picture utilities = draw_void_utility(map, content);
  EXPECT_GT(more(utilities, green), 100U);
  EXPECT_GT(more(utilities, red), 100U);
  utility.pop_back();
  content.utility = utility;
  EXPECT_THROW((void)draw_void_utility(map, content), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
