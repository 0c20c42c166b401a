// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <support/hollow_map.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/view/candidate_views.hpp>
#include <vantage/view/sensing_constraint.hpp>

namespace vantage {
namespace {

// A ball of unknown cells in free space; the surface is occupied on one side.
OccupancyMap ball(double resolution_m, std::int32_t radius) {
  OccupancyMap map({.resolution_m = resolution_m});
  const std::int32_t reach = 3 * radius;
  map.set_log_odds(VoxelBox{{-reach, -reach, -reach}, {reach, reach, reach}}, -2.0);
  for_each_cell(VoxelBox{{-radius, -radius, -radius}, {radius, radius, radius}}, [&](const VoxelIndex& cell) {
    const double from_middle = (Eigen::Vector3d(cell.x, cell.y, cell.z).array() + 0.5).matrix().norm();
    if (from_middle < radius) {
      map.set(cell, from_middle > radius - 1.8 && cell.x < 0 ? Occupancy::Occupied : Occupancy::Unknown);
    }
  });
  return map;
}

TEST(SensingConstraint, NormalsOfABallPointAwayFromItsMiddle) {
  const OccupancyMap map = ball(0.05, 16);
  std::size_t cells = 0;
  for_each_cell({{-16, -16, -16}, {16, 16, 16}}, [&](const VoxelIndex& cell) {
    const bool on_surface = map.at(cell) != Occupancy::Free &&
                            std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
                              return map.at(cell + step) == Occupancy::Free;
                            });
    if (on_surface) {
      const Eigen::Vector3d outwards = map.frame().centre_of(cell).normalized();
      EXPECT_GT(surface_normal(map, cell).cast<double>().dot(outwards), std::cos(0.35)) << "20 degrees";
      ++cells;
    }
  });
  EXPECT_GT(cells, 1000U);
}

TEST(SensingConstraint, KeepsWhatIsInTheDepthOfViewAndTheVisionAngle) {
  std::mt19937 engine(81);
  std::size_t kept = 0;
  std::size_t refused = 0;
  const VoxelBox object{{-10, -10, -10}, {10, 10, 10}};
  for (int world = 0; world < 6; ++world) {
    OccupancyMap map = test::hollow_map(engine, 0.1);
    const RayCaster caster(map);
    const ViewRays rays(RangeSensor::pinhole(64, 48, 1.0, 0.8, 0.0, 5.0));
    const SensingOptions options{.max_incidence_rad = 1.0, .min_depth_m = 0.8, .max_depth_m = 2.5};
    const SensingConstraint constraint = measurable(map, object, options);
    for (const Pose& pose : random_views_of({0.05, 0, 0}, {{-2, -2, -2}, {2, 2, 2}}, 30, 3U + unsigned(world))) {
      CellSet seen;
      (void)evaluate_view(caster, pose, rays, object, &seen);
      CellSet measured = seen;
      constraint(pose, measured);
      seen.for_each([&](const VoxelIndex& cell) {
        const Eigen::Vector3d back = pose.translation() - map.frame().centre_of(cell);
        const Eigen::Vector3d normal = surface_normal(map, cell).cast<double>();
        const bool within = back.norm() >= 0.8 && back.norm() <= 2.5;
        const bool faces = normal.isZero() || std::acos(std::min(normal.dot(back.normalized()), 1.0)) <= 1.0;
        EXPECT_EQ(measured.contains(cell), within && faces);
        (within && faces ? kept : refused) += 1;
      });
      seen -= measured;
      measured -= seen;
      EXPECT_EQ(measured.size() + seen.size(), [&] {
        CellSet all;
        (void)evaluate_view(caster, pose, rays, object, &all);
        return all.size();
      }()) << "adds nothing";
    }
  }
  EXPECT_GT(kept, 200U);
  EXPECT_GT(refused, 200U);
}

TEST(SensingConstraint, NamesWhatIsWrong) {
  EXPECT_FALSE(SensingOptions{}.restricts());
  EXPECT_TRUE(SensingOptions{.max_incidence_rad = 1.0}.restricts());
  EXPECT_NO_THROW(validate(SensingOptions{}));
  EXPECT_THROW(validate({.max_incidence_rad = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate({.max_incidence_rad = 2.0}), std::invalid_argument);
  EXPECT_THROW(validate({.min_depth_m = -1.0}), std::invalid_argument);
  EXPECT_THROW(validate({.min_depth_m = 2.0, .max_depth_m = 2.0}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
