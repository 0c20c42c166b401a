// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vantage/view/unseen_surface.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr VoxelBox kWallBox{{-8, -8, -8}, {8, 8, 8}};

// A wall of one cell across x in a room in which all is known but the cells of `is_unknown`.
template <class IsUnknown>
OccupancyMap wall_map(const IsUnknown& unknown) {
  OccupancyMap map({.resolution_m = 0.05});
  map.set_log_odds(VoxelBox{{-60, -60, -60}, {60, 60, 60}}, -2.0);
  for_each_cell({{0, -5, -5}, {1, 5, 5}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Occupied); });
  for_each_cell(kWallBox, [&](const VoxelIndex& cell) {
    if (unknown(cell)) {
      map.set(cell, Occupancy::Unknown);
    }
  });
  return map;
}

const ViewRays kRays(RangeSensor::pinhole(120, 120, 0.9, 0.9, 0.0, 4.0));
const Pose kInFront = pose_looking({-1.5, 0.01, 0.02}, 0.0);
const Pose kBehind = pose_looking({1.5, 0.01, 0.02}, 3.14159265);

// Weight of the sides of one cell that a flat surface leaves to see: the one across a face. The others are not open.
constexpr std::size_t kFlat = 4;

TEST(UnseenSurface, KnowsWhichSideOfAWallWasLookedAt) {
  const OccupancyMap map = wall_map([](const VoxelIndex&) { return false; });
  UnseenSurface surface(map, kWallBox);
  surface.look(map, kInFront, kRays);
  EXPECT_GE(surface.looked_at(), 100 * kFlat) << "10 x 10 cells, and sides of the rim";
  EXPECT_TRUE(surface.expected(kInFront, kRays).empty());
  const auto behind = surface.expected(kBehind, kRays);
  EXPECT_GE(UnseenSurface::weight_of(behind), 100 * kFlat);
  for (const UnseenSurface::Side side : behind) {
    EXPECT_EQ(map.at(surface.cell_of(side)), Occupancy::Occupied);
    EXPECT_GE(UnseenSurface::towards(side).x, 0);
  }
  surface.look(map, kBehind, kRays);
  EXPECT_TRUE(surface.expected(kBehind, kRays).empty());
  for (const CellSide& side : surface.left()) {
    EXPECT_EQ(side.normal.x, 0) << "only the rim is left";
  }
  EXPECT_GE(surface.left().size(), 36U);
}

// By definition: every side across a thin rod, of every cell, from directions all around.
TEST(UnseenSurface, SeesTheSidesThatFaceTheSensorUnder85Degrees) {
  OccupancyMap map({.resolution_m = 0.05});
  map.set_log_odds(VoxelBox{{-60, -60, -60}, {60, 60, 60}}, -2.0);
  const VoxelBox rod{{0, 0, -3}, {1, 1, 3}};
  for_each_cell(rod, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Occupied); });
  std::size_t seen = 0;
  std::size_t unseen = 0;
  for (int view = 0; view < 24; ++view) {
    const double angle = 0.26 * view + 0.1;
    const Eigen::Vector3d place(1.5 * std::cos(angle), 1.5 * std::sin(angle), 0.013 * view);
    const Pose pose = pose_looking_along(place, -place);
    UnseenSurface surface(map, kWallBox);
    surface.look(map, pose, kRays);
    const std::vector<CellSide> left = surface.left();
    for_each_cell(rod, [&](const VoxelIndex& cell) {
      const Eigen::Vector3d back = (place - map.frame().centre_of(cell)).normalized();
      for (const VoxelIndex& step : kAllNeighbours) {
        if (step.z != 0) {
          continue;  // not open, or single at the ends
        }
        const double cosine = back.dot(Eigen::Vector3d(step.x, step.y, step.z).normalized());
        const bool is_left = std::any_of(
            left.begin(), left.end(), [&](const CellSide& side) { return side.cell == cell && side.normal == step; });
        EXPECT_EQ(is_left, cosine <= 0.087) << "view " << view;
        ++(is_left ? unseen : seen);
      }
    });
  }
  EXPECT_GT(seen, 400U);
  EXPECT_GT(unseen, 400U);
}

// A bump of one cell on a wall is a step of the grid; the flanks of a ridge are surface.
TEST(UnseenSurface, LooksForRowsOfSidesOnly) {
  for (const std::int32_t half_length : {0, 3}) {
    OccupancyMap map = wall_map([](const VoxelIndex&) { return false; });
    const VoxelBox ridge{{-1, 2, 1 - half_length}, {0, 3, 2 + half_length}};
    for_each_cell(ridge, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Occupied); });
    UnseenSurface surface(map, kWallBox);
    surface.look(map, kInFront, kRays);
    std::size_t flanks = 0;
    for (const CellSide& side : surface.left()) {
      flanks += ridge.contains(side.cell) && side.normal.x == 0 && side.normal.z == 0 ? 1U : 0U;
    }
    EXPECT_EQ(flanks, half_length == 0 ? 0U : 2U * 5U) << "all but those of the ends, which have one beside them";
  }
}

// Two opposite views of a thin rod across a corner leave the sides that both saw edge-on.
TEST(UnseenSurface, OppositeViewsOfAThinRodLeaveItsSilhouette) {
  OccupancyMap map({.resolution_m = 0.05});
  map.set_log_odds(VoxelBox{{-60, -60, -60}, {60, 60, 60}}, -2.0);
  for_each_cell({{0, 0, -3}, {1, 1, 3}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Occupied); });
  UnseenSurface surface(map, kWallBox);
  const Eigen::Vector3d middle(0.025, 0.025, 0.0);
  const Eigen::Vector3d across(1.0, 1.0, 0.0);
  for (const double there : {-1.0, 1.0}) {
    surface.look(map, pose_looking_along(middle + there * across, -there * across), kRays);
  }
  const Eigen::Vector3d beside = middle + Eigen::Vector3d(1.0, -1.0, 0.0);
  EXPECT_GT(UnseenSurface::weight_of(surface.expected(pose_looking_along(beside, middle - beside), kRays)), 0U);
}

TEST(UnseenSurface, ExpectsTheBackOfASurfaceThroughWhatIsUnknown) {
  const OccupancyMap map = wall_map([](const VoxelIndex& cell) { return cell.x > 0; });
  UnseenSurface surface(map, kWallBox);
  surface.look(map, kInFront, kRays);
  const auto in_front = surface.expected(kInFront, kRays);
  const auto behind = surface.expected(kBehind, kRays);
  EXPECT_GT(UnseenSurface::weight_of(behind), 80 * kFlat) << "the back of the wall, or what may hide it";
  EXPECT_GT(UnseenSurface::weight_of(behind), 2 * UnseenSurface::weight_of(in_front));
}

// A map that knows the surroundings may leave the cells around the box unknown.
TEST(UnseenSurface, LooksThroughUnknownCellsAroundTheBox) {
  for (const bool learns : {false, true}) {
    OccupancyMap map = wall_map([](const VoxelIndex& cell) { return cell.x > 0; });
    for_each_cell(kWallBox.grown(1), [&](const VoxelIndex& cell) {
      if (!kWallBox.contains(cell)) {
        map.set(cell, Occupancy::Unknown);
      }
    });
    UnseenSurface surface(map, kWallBox);
    surface.look(map, kInFront, kRays);
    EXPECT_GT(UnseenSurface::weight_of(surface.expected(kBehind, kRays)), 80 * kFlat);
    if (learns) {
      // The map learns of the cells around the box, in bricks whose assumptions are made anew.
      map.set({9, 0, 0}, Occupancy::Free);
      map.set({-9, 7, 0}, Occupancy::Free);
    }
    surface.look(map, kInFront, kRays);
    EXPECT_EQ(surface.caster().at({1, 7, 0}), Occupancy::Free) << "a ray passed there";
    EXPECT_GT(UnseenSurface::weight_of(surface.expected(kBehind, kRays)), 80 * kFlat);
  }
}

// Rays that pass the wall and return nothing mark their cells as free.
TEST(UnseenSurface, TakesForFreeWhatRaysHavePassed) {
  const auto beside = [](const VoxelIndex& cell) { return cell.y > 5; };
  const OccupancyMap map = wall_map(beside);
  UnseenSurface surface(map, kWallBox);
  surface.look(map, kInFront, kRays);
  for (const UnseenSurface::Side side : surface.expected(kBehind, kRays)) {
    EXPECT_FALSE(beside(surface.cell_of(side)));
  }
  EXPECT_EQ(surface.caster().at({0, 7, 0}), Occupancy::Free);
  EXPECT_EQ(map.at({0, 7, 0}), Occupancy::Unknown);
}

// The sides of so many cells have no numbers; it is said before memory is asked for.
TEST(UnseenSurface, RefusesABoxOfTooManyCells) {
  const OccupancyMap map({.resolution_m = 0.05});
  constexpr std::int32_t kHalf = 1 << 18;
  EXPECT_THROW(UnseenSurface(map, {{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}}), std::length_error);
}

}  // namespace
}  // namespace vantage
