// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <support/hollow_map.hpp>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/raytrace/impl/view_placer.hpp>
#include <vantage/view/candidate_views.hpp>
#include <vantage/view/information_gain.hpp>

namespace vantage {
namespace {

// A partly observed object in a box of free cells with other objects.
OccupancyMap half_seen_object(std::mt19937& engine) {
  OccupancyMap map = test::hollow_map(engine, 0.1);
  std::uniform_real_distribution<double> log_odds(-2.0, 3.5);
  for_each_cell({{-5, -5, -5}, {5, 5, 5}}, [&](const VoxelIndex& cell) {
    const auto draw = engine() % 8;
    if (draw < 5) {
      map.set(cell, Occupancy::Unknown);
    } else {
      map.set_log_odds(cell, draw < 7 ? -std::abs(log_odds(engine)) : log_odds(engine));
    }
  });
  return map;
}

double probability(const OccupancyMap& map, const VoxelIndex& cell) {
  return 1.0 / (1.0 + std::exp(-map.log_odds(cell).value_or(0.0)));
}

double surface_distance_m(const OccupancyMap& map, const VoxelBox& object, const VoxelIndex& from) {
  double nearest = std::numeric_limits<double>::infinity();
  for_each_cell(object, [&](const VoxelIndex& cell) {
    if (map.at(cell) == Occupancy::Occupied) {
      nearest = std::min(nearest, (map.frame().centre_of(cell) - map.frame().centre_of(from)).norm());
    }
  });
  return nearest;
}

struct Gains {
  double occlusion_aware = 0.0;
  double unobserved_voxel = 0.0;
  double rear_side_voxel = 0.0;
  double rear_side_entropy = 0.0;
  double proximity_count = 0.0;
};

// The definitions, by walking each ray cell by cell through the map.
Gains gains_by_definition(const OccupancyMap& map, const Pose& pose, const ViewRays& rays, const VoxelBox& object,
                          double d_max_m) {
  const detail::RayPlacer placer = detail::view_placer(pose, rays, map.frame());
  Gains gains;
  detail::RayBlock block;
  for (const RayTile& tile : rays.tiles()) {
    placer.place_ends(tile.directions, tile.stretch, block);
    for (std::uint64_t left = tile.rays; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const Eigen::Vector3d end(block.end[0][i], block.end[1][i], block.end[2][i]);
      bool inside = false;
      bool after_unknown = false;
      double visible = 1.0;
      double last_unknown = 0.0;
      for (const VoxelIndex& cell : VoxelRay(map.frame(), pose.translation(), end)) {
        if (!object.contains(cell)) {
          if (inside || map.at(cell) != Occupancy::Free) {
            break;
          }
          continue;
        }
        inside = true;
        const double p = probability(map, cell);
        const double seen_entropy = visible * (-p * std::log(p) - (1.0 - p) * std::log(1.0 - p));
        visible *= 1.0 - p;
        gains.occlusion_aware += seen_entropy;
        if (map.at(cell) == Occupancy::Unknown) {
          gains.unobserved_voxel += seen_entropy;
          gains.proximity_count += std::max(d_max_m - surface_distance_m(map, object, cell), 0.0);
          last_unknown = seen_entropy;
        }
        if (map.at(cell) == Occupancy::Occupied) {
          gains.rear_side_voxel += after_unknown ? 1.0 : 0.0;
          gains.rear_side_entropy += after_unknown ? last_unknown : 0.0;
          break;
        }
        after_unknown = map.at(cell) == Occupancy::Unknown;
      }
    }
  }
  return gains;
}

TEST(InformationGain, IsWhatAWalkFromCellToCellFinds) {
  std::mt19937 engine(71);
  const VoxelBox object{{-6, -6, -6}, {6, 6, 6}};
  constexpr double kMostM = 0.22;
  std::size_t views = 0;
  std::size_t rear_sides = 0;
  for (int world = 0; world < 6; ++world) {
    const OccupancyMap map = half_seen_object(engine);
    const RayCaster caster(map);
    const ViewRays rays(RangeSensor::pinhole(16, 12, 1.0, 0.8, 0.0, 5.0));
    const auto by = [&](RayGain gain) { return ViewGain(map, caster, rays, object, std::move(gain)); };
    const ViewGain aware = by(occlusion_aware());
    const ViewGain unobserved = by(unobserved_voxel());
    const ViewGain rear = by(rear_side_voxel());
    const ViewGain rear_entropy = by(rear_side_entropy());
    const ViewGain proximity = by(proximity_count(map, object, kMostM));
    for (const Pose& pose : random_views_of({0.05, 0.0, 0.0}, {{-2, -2, -2}, {2, 2, 2}}, 12, 5U + unsigned(world))) {
      const Gains expected = gains_by_definition(map, pose, rays, object, kMostM);
      EXPECT_NEAR(aware(pose), expected.occlusion_aware, 1e-9 * (1.0 + expected.occlusion_aware));
      EXPECT_NEAR(unobserved(pose), expected.unobserved_voxel, 1e-9 * (1.0 + expected.unobserved_voxel));
      EXPECT_EQ(rear(pose), expected.rear_side_voxel);
      EXPECT_NEAR(rear_entropy(pose), expected.rear_side_entropy, 1e-9 * (1.0 + expected.rear_side_entropy));
      EXPECT_NEAR(proximity(pose), expected.proximity_count, 1e-9 * (1.0 + expected.proximity_count));
      EXPECT_EQ(proximity(pose, 3), proximity(pose)) << "by any number of threads";
      views += expected.unobserved_voxel > 0.0 ? 1U : 0U;
      rear_sides += expected.rear_side_voxel > 0.0 ? 1U : 0U;
    }
  }
  EXPECT_GT(views, 40U);
  EXPECT_GT(rear_sides, 25U);
}

TEST(InformationGain, MayBeAnyFunctionOfARay) {
  std::mt19937 engine(72);
  const OccupancyMap map = half_seen_object(engine);
  const RayCaster caster(map);
  const ViewRays rays(RangeSensor::pinhole(24, 18, 1.0, 0.8, 0.0, 5.0));
  const VoxelBox object{{-5, -5, -5}, {5, 5, 5}};
  const ViewGain rays_that_meet(map, caster, rays, object, [](std::span<const RayCell>) { return 1.0; });
  const Pose pose = pose_looking_along({-0.75, 0.02, 0.03}, {1, 0, 0});
  EXPECT_GT(rays_that_meet(pose), 0.0);
  EXPECT_LE(rays_that_meet(pose), static_cast<double>(rays.size()));
  EXPECT_EQ(rays_that_meet(pose_looking_along({-0.75, 0.02, 0.03}, {-1, 0, 0})), 0.0);
  EXPECT_THROW(ViewGain(map, caster, rays, object, nullptr), std::invalid_argument);
  EXPECT_THROW((void)proximity_count(map, object, 0.0), std::invalid_argument);
}

TEST(InformationGain, IsKnownByName) {
  EXPECT_EQ(ray_gain_names().size(), 5U);
  for (const std::string_view name : ray_gain_names()) {
    EXPECT_TRUE(ray_gain_named(name));
  }
  try {
    (void)ray_gain_named("entropy");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("rear-side-entropy"), std::string::npos);
  }
}

}  // namespace
}  // namespace vantage
