// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <stdexcept>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vantage/robot/wrapped_platform.hpp>

namespace vantage {
namespace {

constexpr std::int32_t kHighestX = 6;

// Admits nothing beyond a plane.
class BehindPlane final : public WrappedPlatform {
 public:
  using WrappedPlatform::WrappedPlatform;
  [[nodiscard]] bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const override {
    return cell.x <= kHighestX && wrapped().admits_cell(map, cell);
  }
};

OccupancyMap random_map(std::mt19937& engine) {
  OccupancyMap map({.resolution_m = 0.25});
  for_each_cell({{-2, -2, -2}, {14, 14, 14}}, [&](const VoxelIndex& cell) {
    map.set(cell, engine() % 40 == 0 ? Occupancy::Occupied : Occupancy::Free);
  });
  return map;
}

TEST(WrappedPlatform, AnswersAsTheWrappedOne) {
  std::mt19937 engine(7);
  const auto flyer = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2, .yaw_only = true});
  const WrappedPlatform wrapping(flyer);
  EXPECT_EQ(wrapping.reach_m(), flyer->reach_m());
  EXPECT_EQ(wrapping.can_tilt(), flyer->can_tilt());
  std::uniform_real_distribution<double> metres(0.0, 3.2);
  const auto random_place = [&] { return Eigen::Vector3d(metres(engine), metres(engine), metres(engine)); };
  std::size_t admitted = 0;
  std::size_t paths = 0;
  for (int world = 0; world < 20; ++world) {
    const OccupancyMap map = random_map(engine);
    const VoxelBox box{{0, 0, 0}, {9, 9, 9}};
    EXPECT_EQ(wrapping.admitted_cells(map, box).values(), flyer->admitted_cells(map, box).values());
    for (int pair = 0; pair < 20; ++pair) {
      const Eigen::Vector3d away = random_place();
      const Pose from = flyer->facing(random_place(), away);
      const Pose to = flyer->facing(random_place(), away);
      EXPECT_TRUE(wrapping.facing(from.translation(), away).isApprox(from));
      EXPECT_EQ(wrapping.admits(map, from), flyer->admits(map, from));
      EXPECT_EQ(wrapping.admits_cell(map, map.frame().cell_of(from.translation())),
                flyer->admits_cell(map, map.frame().cell_of(from.translation())));
      EXPECT_EQ(wrapping.admits_motion(map, from, to), flyer->admits_motion(map, from, to));
      EXPECT_EQ(wrapping.distance_m(from, to), flyer->distance_m(from, to));
      EXPECT_EQ(wrapping.body_box(from).min, flyer->body_box(from).min);
      EXPECT_EQ(wrapping.body_box(from).max, flyer->body_box(from).max);
      const auto path = flyer->path(map, from, to);
      const auto same = wrapping.path(map, from, to);
      ASSERT_EQ(path.has_value(), same.has_value());
      EXPECT_EQ(path ? path->size() : 0, same ? same->size() : 0);
      admitted += flyer->admits(map, from) ? 1U : 0U;
      paths += path ? 1U : 0U;
    }
  }
  EXPECT_GT(admitted, 50U);
  EXPECT_GT(paths, 20U);
}

TEST(WrappedPlatform, AdmittedCellsAreThoseThatTheDerivedClassAdmits) {
  std::mt19937 engine(8);
  const auto flyer = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2});
  const BehindPlane behind(flyer);
  const OccupancyMap map = random_map(engine);
  const VoxelBox box{{0, 0, 0}, {12, 12, 12}};
  const auto all = flyer->admitted_cells(map, box);
  const auto some = behind.admitted_cells(map, box);
  std::size_t withheld = 0;
  for_each_cell(box, [&](const VoxelIndex& cell) {
    EXPECT_EQ(some[cell], cell.x <= kHighestX ? all[cell] : 0);
    withheld += some[cell] == all[cell] ? 0U : 1U;
  });
  EXPECT_GT(withheld, 100U);
}

TEST(WrappedPlatform, NeedsAPlatform) { EXPECT_THROW(WrappedPlatform(nullptr), std::invalid_argument); }

}  // namespace
}  // namespace vantage
