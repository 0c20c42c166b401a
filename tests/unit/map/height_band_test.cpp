// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/map/height_band.hpp>
#include <vantage/robot/ground_robot.hpp>

namespace vantage {
namespace {

constexpr double kCell = 0.1;

/// Whether the floor is searched in this cell: it is below the band, and within one step.
bool may_hold_the_floor(const OccupancyMap& map, const VoxelIndex& cell, const HeightBandOptions& options) {
  return map.frame().centre_of(cell).z() < options.min_height_m &&
         map.frame().box_of(cell).max.z() > options.min_height_m - options.step_height_m;
}

/// Whether a floor was seen or, unless something is known of the cell below all that could hold it, declared.
bool has_floor(const OccupancyMap& map, std::int32_t x, std::int32_t y, const HeightBandOptions& options,
               bool is_declared) {
  std::int32_t below = 40;
  while (map.frame().box_of(VoxelIndex{x, y, below}).max.z() > options.min_height_m - options.step_height_m) {
    --below;
    if (may_hold_the_floor(map, {x, y, below}, options) && map.at({x, y, below}) == Occupancy::Occupied) {
      return true;
    }
  }
  return is_declared && map.at({x, y, below}) == Occupancy::Unknown;
}

/// The state of one column by definition.
Occupancy column_of(const OccupancyMap& map, std::int32_t x, std::int32_t y, const HeightBandOptions& options) {
  int cells = 0;
  int free = 0;
  for (std::int32_t z = -40; z < 40; ++z) {
    const VoxelIndex cell{x, y, z};
    const double height_m = map.frame().centre_of(cell).z();
    if (height_m < options.min_height_m || height_m > options.max_height_m) {
      continue;
    }
    if (map.at(cell) == Occupancy::Occupied) {
      return Occupancy::Occupied;
    }
    ++cells;
    free += map.at(cell) == Occupancy::Free ? 1 : 0;
  }
  if (free == 0 || free < options.free_share * cells) {
    return Occupancy::Unknown;
  }
  return Occupancy::Free;
}

void change_at_random(OccupancyMap& map, std::mt19937& engine) {
  std::uniform_int_distribution<std::int32_t> place(-12, 11);
  std::uniform_int_distribution<std::int32_t> height(-20, 19);
  std::uniform_int_distribution<int> state(0, 9);
  for (int i = 0; i < 150; ++i) {
    const VoxelIndex lo{place(engine), place(engine), height(engine)};
    const int drawn = state(engine);
    if (drawn < 7) {
      map.set_log_odds(VoxelBox{lo, lo + VoxelIndex{3, 3, 9}}, -2.0);
    } else {
      map.set(lo, drawn == 7 ? Occupancy::Unknown : Occupancy::Occupied);
    }
  }
}

TEST(HeightBand, IsWhatItsColumnsAreAfterEveryChange) {
  std::size_t compared = 0;
  std::size_t occupied = 0;
  std::size_t with_floor = 0;
  std::size_t without_floor = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> metre(-1.5, 1.0);
    const double low = metre(engine);
    const HeightBandOptions options{.min_height_m = low,
                                    .max_height_m = low + 0.73,
                                    .sensor_height_m = metre(engine),
                                    .free_share = seed % 3 == 0 ? 0.5 : 1.0,
                                    .needs_floor = seed % 3 != 0 && seed % 4 > 1,
                                    .step_height_m = 0.137 * (seed % 4)};
    OccupancyMap map({.resolution_m = kCell});
    HeightBand band(map.options(), options);
    const Eigen::Vector3d declared(metre(engine), metre(engine), 0.3);
    band.assume_floor(declared, 0.6);
    for (int change = 0; change < 6; ++change) {
      change_at_random(map, engine);
      band.follow(map);
      const std::int32_t layer = map.frame().cell_of({0.0, 0.0, options.sensor_height_m}).z;
      EXPECT_EQ(band.plane().region()->lo.z, layer);
      EXPECT_EQ(band.plane().region()->hi.z, layer + 1);
      for_each_cell(VoxelBox{{-16, -16, layer}, {16, 16, layer + 1}}, [&](const VoxelIndex& cell) {
        const Occupancy expected = column_of(map, cell.x, cell.y, options);
        ASSERT_EQ(band.plane().at(cell), expected) << "seed " << seed << ", change " << change;
        const Box column = map.frame().box_of(cell);
        const Eigen::Vector2d nearest =
            declared.head<2>().cwiseMax(column.min.head<2>()).cwiseMin(column.max.head<2>());
        const bool is_declared = (nearest - declared.head<2>()).norm() <= 0.6;
        const bool clear = expected == Occupancy::Free &&
                           (!options.needs_floor || has_floor(map, cell.x, cell.y, options, is_declared));
        ASSERT_EQ(band.plane().is_clear(cell), clear) << "seed " << seed << ", change " << change;
        ASSERT_EQ(band.plane().contested(cell), expected == Occupancy::Free && !clear);
        ++compared;
        occupied += expected == Occupancy::Occupied ? 1U : 0U;
        with_floor += clear ? 1U : 0U;
        without_floor += band.plane().contested(cell) ? 1U : 0U;
      });
    }
  }
  EXPECT_EQ(compared, 12U * 6U * 32U * 32U);
  EXPECT_GT(occupied, 500U);
  EXPECT_GT(with_floor, 1000U);
  EXPECT_GT(without_floor, 500U);
}

// A hall with a floor and a pit of 2 m whose inside was observed.
TEST(HeightBand, AGroundRobotKeepsOutOfAPit) {
  OccupancyMap map({.resolution_m = kCell});
  map.set_log_odds(VoxelBox{{0, 0, -1}, {40, 30, 0}}, 3.5);
  map.set_log_odds(VoxelBox{{0, 0, 0}, {40, 30, 14}}, -2.0);
  const VoxelBox pit{{10, 5, -20}, {30, 25, 0}};
  map.set_log_odds(pit, -2.0);
  map.set_log_odds(VoxelBox{{10, 5, -21}, {30, 25, -20}}, 3.5);
  const GroundRobot robot({.radius_m = 0.15});
  for (const bool needs_floor : {false, true}) {
    HeightBand band(map.options(),
                    {.min_height_m = 0.1, .max_height_m = 1.0, .sensor_height_m = 0.55, .needs_floor = needs_floor});
    band.follow(map);
    std::size_t over_the_pit = 0;
    std::size_t elsewhere = 0;
    band.plane().for_each_known([&](const VoxelIndex& cell, Occupancy /*state*/) {
      const bool over = pit.contains({cell.x, cell.y, -1});
      (over ? over_the_pit : elsewhere) += robot.admits_cell(band.plane(), cell) ? 1U : 0U;
    });
    EXPECT_EQ(over_the_pit, needs_floor ? 0U : 400U);
    EXPECT_GT(elsewhere, 300U);
  }
}

TEST(HeightBand, WhereNoFloorWasSeenSightPassesButNoBody) {
  OccupancyMap map({.resolution_m = kCell});
  map.set_log_odds(VoxelBox{{0, 0, 0}, {20, 20, 14}}, -2.0);
  map.set_log_odds(VoxelBox{{0, 0, -1}, {10, 20, 0}}, 3.5);
  HeightBand band(map.options(), {.min_height_m = 0.1, .max_height_m = 1.0, .sensor_height_m = 0.55});
  const auto at = [&](std::int32_t x) {
    band.follow(map);
    return std::pair(band.plane().at({x, 3, 5}), band.plane().is_clear({x, 3, 5}));
  };
  EXPECT_EQ(at(9), std::pair(Occupancy::Free, true));
  EXPECT_EQ(at(10), std::pair(Occupancy::Free, false));
  band.assume_floor({1.25, 0.35, 0.8}, 0.26);
  EXPECT_EQ(at(14), std::pair(Occupancy::Free, true));
  EXPECT_EQ(at(16), std::pair(Occupancy::Free, false));
  map.set_log_odds(VoxelBox{{10, 0, -4}, {20, 20, 0}}, -2.0);
  EXPECT_EQ(at(14), std::pair(Occupancy::Free, false)) << "declared, but a ray went deeper";
  map.set(VoxelIndex{14, 3, -2}, Occupancy::Occupied);
  EXPECT_EQ(at(14), std::pair(Occupancy::Free, true)) << "a step down";
  EXPECT_THROW(band.assume_floor({0.0, 0.0, 0.0}, -1.0), std::invalid_argument);
  EXPECT_THROW(band.assume_floor({0.0, std::nan(""), 0.0}, 1.0), std::invalid_argument);
}

TEST(HeightBand, TellsOfALookInVainWithoutAChange) {
  OccupancyMap map({.resolution_m = kCell});
  HeightBand band(map.options(), {.min_height_m = 0.0, .max_height_m = 0.5, .sensor_height_m = 0.2});
  map.set_log_odds(VoxelBox{{0, 0, 0}, {8, 8, 5}}, -2.0);
  band.follow(map);
  const OccupancyMap::Revision before = band.plane().revision();
  band.follow(map);
  EXPECT_EQ(band.plane().revision(), before);
  map.set({3, 3, 30}, Occupancy::Occupied);  // above the band
  map.set({3, 3, 7}, Occupancy::Occupied);   // also above the band, but in the same brick
  band.follow(map);
  EXPECT_GT(band.plane().revision(), before);
  EXPECT_TRUE(band.plane().changed_since(before).empty());
  EXPECT_EQ(band.plane().at({3, 3, 2}), Occupancy::Free);
  map.set({3, 3, 4}, Occupancy::Occupied);
  band.follow(map);
  EXPECT_EQ(band.plane().at({3, 3, 2}), Occupancy::Occupied);
}

TEST(HeightBand, KeepsToTheRegionOfTheMap) {
  OccupancyMap map({.resolution_m = kCell, .region = Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}});
  HeightBand band(map.options(),
                  {.min_height_m = 0.0, .max_height_m = 0.5, .sensor_height_m = 0.25, .needs_floor = false});
  EXPECT_EQ(*band.plane().region(), (VoxelBox{{0, 0, 2}, {10, 10, 3}}));
}

TEST(HeightBand, ProjectsAnotherMapFromItsBeginning) {
  OccupancyMap first({.resolution_m = kCell});
  HeightBand band(first.options(), {.min_height_m = 0.0, .max_height_m = 0.5, .sensor_height_m = 0.25});
  first.set_log_odds(VoxelBox{{0, 0, 0}, {8, 8, 5}}, -2.0);
  first.set({0, 0, 0}, Occupancy::Occupied);
  band.follow(first);
  OccupancyMap second({.resolution_m = kCell});
  second.set_log_odds(VoxelBox{{4, 4, 0}, {8, 8, 5}}, -2.0);
  band.follow(second);
  EXPECT_EQ(band.plane().at({0, 0, 2}), Occupancy::Unknown);
  EXPECT_EQ(band.plane().at({5, 5, 2}), Occupancy::Free);
}

TEST(HeightBand, NamesTheOptionAtFault) {
  const auto message = [](const HeightBandOptions& options, std::optional<Box> region = {}) -> std::string {
    try {
      const HeightBand band({.resolution_m = kCell, .region = region}, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({.min_height_m = 1.0, .max_height_m = 0.5}),
            "HeightBandOptions::max_height_m is 0.5, must be >= min_height_m");
  EXPECT_EQ(
      message({.min_height_m = 0.46, .max_height_m = 0.54}),
      "HeightBandOptions::max_height_m is 0.54, must be such that the centre of a cell lies between the heights");
  EXPECT_EQ(message({.free_share = 0.0}), "HeightBandOptions::free_share is 0, must be in (0, 1]");
  EXPECT_NE(message({.sensor_height_m = std::nan("")}).find("sensor_height_m"), std::string::npos);
  EXPECT_EQ(message({.step_height_m = -0.1}), "HeightBandOptions::step_height_m is -0.1, must be in [0, 1000]");
  EXPECT_EQ(message({.step_height_m = std::nan("")}),
            "HeightBandOptions::step_height_m is nan, must be in [0, 1000]");
  EXPECT_EQ(message({.step_height_m = INFINITY}), "HeightBandOptions::step_height_m is inf, must be in [0, 1000]");
  const Box storey{{0.0, 0.0, 0.0}, {3.0, 3.0, 2.0}};
  EXPECT_EQ(message({.min_height_m = 2.5, .max_height_m = 3.0, .sensor_height_m = 1.0}, storey),
            "HeightBandOptions::min_height_m is 2.5, must be below the top of the map's region");
  EXPECT_EQ(message({.min_height_m = -1.0, .max_height_m = 0.0, .sensor_height_m = 1.0}, storey),
            "HeightBandOptions::max_height_m is 0, must be above the bottom of the map's region");
  EXPECT_EQ(message({.min_height_m = 0.5, .max_height_m = 1.5, .sensor_height_m = 2.5}, storey),
            "HeightBandOptions::sensor_height_m is 2.5, must be within the map's region");
  EXPECT_EQ(message({.min_height_m = 0.5, .max_height_m = 2.5, .sensor_height_m = 1.9}, storey), "");
  EXPECT_EQ(
      message({.min_height_m = 0.0, .max_height_m = 1.0}, storey),
      "HeightBandOptions::needs_floor: the map's region holds no cell below the band, so no floor is ever seen");
  EXPECT_EQ(message({.min_height_m = 0.0, .max_height_m = 1.0, .needs_floor = false}, storey), "");
  HeightBand band({.resolution_m = kCell}, {});
  EXPECT_THROW(band.follow(OccupancyMap({.resolution_m = 0.2})), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
