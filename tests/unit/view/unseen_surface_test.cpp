// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vantage/view/unseen_surface.hpp>

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

TEST(UnseenSurface, KnowsWhichSideOfAWallWasLookedAt) {
  const OccupancyMap map = wall_map([](const VoxelIndex&) { return false; });
  UnseenSurface surface(map, kWallBox);
  surface.look(map, kInFront, kRays);
  EXPECT_EQ(surface.looked_at(), 100U) << "faces of 10 x 10 cells";
  EXPECT_TRUE(surface.expected(kInFront, kRays).empty());
  const auto behind = surface.expected(kBehind, kRays);
  ASSERT_EQ(behind.size(), 100U);
  for (const UnseenSurface::Face face : behind) {
    EXPECT_EQ(map.at(surface.cell_of(face)), Occupancy::Occupied);
    EXPECT_EQ(face % 6, 1U) << "towards +x";
  }
  surface.look(map, kBehind, kRays);
  EXPECT_TRUE(surface.expected(kBehind, kRays).empty());
  // Only the rim of the wall is left: 4 x 10 faces.
  EXPECT_EQ(surface.left().size(), 40U);
}

TEST(UnseenSurface, ExpectsTheBackOfASurfaceThroughWhatIsUnknown) {
  const OccupancyMap map = wall_map([](const VoxelIndex& cell) { return cell.x > 0; });
  UnseenSurface surface(map, kWallBox);
  surface.look(map, kInFront, kRays);
  const auto in_front = surface.expected(kInFront, kRays);
  const auto behind = surface.expected(kBehind, kRays);
  EXPECT_GT(behind.size(), 80U) << "the back of the wall, or what may hide it";
  EXPECT_GT(behind.size(), 2 * in_front.size());
}

// Rays that pass the wall and return nothing mark their cells as free.
TEST(UnseenSurface, TakesForFreeWhatRaysHavePassed) {
  const auto beside = [](const VoxelIndex& cell) { return cell.y > 5; };
  const OccupancyMap map = wall_map(beside);
  UnseenSurface surface(map, kWallBox);
  surface.look(map, kInFront, kRays);
  for (const UnseenSurface::Face face : surface.expected(kBehind, kRays)) {
    EXPECT_FALSE(beside(surface.cell_of(face)));
  }
  EXPECT_EQ(surface.caster().at({0, 7, 0}), Occupancy::Free);
  EXPECT_EQ(map.at({0, 7, 0}), Occupancy::Unknown);
}

// The faces of so many cells have no numbers; it is said before memory is asked for.
TEST(UnseenSurface, RefusesABoxOfTooManyCells) {
  const OccupancyMap map({.resolution_m = 0.05});
  constexpr std::int32_t kHalf = 1 << 18;
  EXPECT_THROW(UnseenSurface(map, {{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}}), std::length_error);
}

}  // namespace
}  // namespace vantage
