// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <support/hollow_map.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/view/aimed_views.hpp>

namespace vantage {
namespace {

CellSet unknown_cells_of(const OccupancyMap& map) {
  CellSet cells(map.bounds());
  for_each_cell(map.bounds(), [&](const VoxelIndex& cell) {
    if (map.at(cell) == Occupancy::Unknown) {
      cells.insert(cell);
    }
  });
  return cells;
}

// The first cell along the optical axis of a view that is not free.
RayEnd looked_at(const OccupancyMap& map, const Pose& view, double furthest_m) {
  const Eigen::Vector3d from = view.translation();
  return first_not_free(map, map.frame(), from, from + furthest_m * optical_axis(view));
}

TEST(AimedViews, EachSeesAnUnknownCellAcrossAFace) {
  std::mt19937 engine(11);
  std::size_t views = 0;
  std::size_t repeated = 0;
  for (int round = 0; round < 6; ++round) {
    const OccupancyMap map = test::hollow_map(engine, 0.1);
    const RayCaster caster(map);
    const CellSet sought = unknown_cells_of(map);
    const AimedViewOptions options{.count = 60, .min_distance_m = 0.2, .max_distance_m = 0.8};
    const std::vector<Pose> aimed = aimed_views(caster, sought, options, 3);
    EXPECT_LE(aimed.size(), options.count);
    for (const Pose& view : aimed) {
      EXPECT_TRUE(is_rigid(view));
      EXPECT_EQ(map.at(map.frame().cell_of(view.translation())), Occupancy::Free);
      const RayEnd end = looked_at(map, view, options.max_distance_m + 0.1);
      EXPECT_EQ(end.occupancy, Occupancy::Unknown);
      EXPECT_TRUE(sought.contains(end.cell));
      const double distance_m = map.frame().box_of(end.cell).distance_to(view.translation());
      EXPECT_GT(distance_m, options.min_distance_m - 0.1);
      EXPECT_LT(distance_m, options.max_distance_m + 0.1);
      ++views;
    }
    const std::vector<Pose> again = aimed_views(caster, sought, options, 3);
    ASSERT_EQ(again.size(), aimed.size());
    for (std::size_t i = 0; i < aimed.size(); ++i, ++repeated) {
      EXPECT_EQ(again[i].matrix(), aimed[i].matrix());
    }
    EXPECT_TRUE(aimed_views(caster, CellSet(map.bounds()), options, 3).empty());
    EXPECT_TRUE(aimed_views(caster, sought, {}, 3).empty());
  }
  EXPECT_GT(views, 150U);
  EXPECT_EQ(views, repeated);
}

// Views of the whole object never see the bottom of an inclined shaft; aimed views do.
TEST(AimedViews, LookDownAShaft) {
  OccupancyMap map({.resolution_m = 0.1});
  map.set_log_odds(VoxelBox{{-20, -20, -20}, {20, 20, 20}}, -2.0);
  map.set_log_odds(VoxelBox{{-3, -3, -3}, {8, 3, 3}}, 3.0);
  for (std::int32_t x = 0; x < 8; ++x) {
    map.set(VoxelIndex{x, 0, 0}, Occupancy::Free);
  }
  const VoxelIndex bottom{-1, 0, 0};
  map.set(bottom, Occupancy::Unknown);
  CellSet sought(map.bounds());
  sought.insert(bottom);
  const std::vector<Pose> aimed =
      aimed_views(RayCaster(map), sought, {.count = 200, .min_distance_m = 1.0, .max_distance_m = 1.5}, 1);
  EXPECT_GT(aimed.size(), 20U);
  for (const Pose& view : aimed) {
    EXPECT_EQ(looked_at(map, view, 2.0).cell, bottom);
    EXPECT_LT(optical_axis(view).x(), -0.9);
  }
}

TEST(AimedViews, NamesWhatIsWrong) {
  const auto complaint = [](const AimedViewOptions& options) -> std::string {
    try {
      validate(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({.min_distance_m = 0.0}), "AimedViewOptions::min_distance_m is 0, must be > 0");
  EXPECT_EQ(complaint({.min_distance_m = 2.0}), "AimedViewOptions::max_distance_m is 1.5, must be >= min_distance_m");
  const OccupancyMap map;
  EXPECT_THROW((void)aimed_views(RayCaster(map), CellSet(), {.count = 0, .min_distance_m = 0.0}, 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace vantage
