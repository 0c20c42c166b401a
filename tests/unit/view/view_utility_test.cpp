// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <support/hollow_map.hpp>
#include <vantage/view/candidate_views.hpp>
#include <vantage/view/view_utility.hpp>

namespace vantage {
namespace {

TEST(ViewUtility, IsTheProductOfThePapersFactors) {
  std::mt19937 engine(51);
  std::size_t views = 0;
  std::size_t useful = 0;
  std::size_t without_overlap = 0;
  for (int world = 0; world < 12; ++world) {
    OccupancyMap map = test::hollow_map(engine, 0.1);
    for_each_cell({{-4, -4, -4}, {5, 5, 5}}, [&](const VoxelIndex& cell) {
      map.set(cell, cell.z > 2 ? Occupancy::Occupied : Occupancy::Unknown);
    });
    const RayCaster caster(map);
    const ViewRays rays(RangeSensor::pinhole(48, 36, 1.0, 0.8, 0.0, 5.0));
    const UniformRayTracer uniform(map);
    const VoxelBox object{{-8, -8, -8}, {9, 9, 9}};
    const Eigen::Vector3d here(0.1, 0.2, 0.3);
    const auto in_free_space = [&](const Pose& pose) {
      return map.at(map.frame().cell_of(pose.translation())) == Occupancy::Free;
    };
    const auto distance_m = [&](const Pose& pose) { return (pose.translation() - here).norm(); };
    const std::size_t min_occupied = 4;
    const UtilityFactors factors{in_free_space, minimum_overlap(min_occupied), unknown_cells(), nearness(distance_m)};
    const std::array<double, 2> radii{1.2, 2.0};
    const std::vector<Pose> candidates = views_around({0.05, 0.0, 0.0}, radii, 0);
    const std::vector<ScoredView> scored = score_views(caster, candidates, rays, object, factors);
    ASSERT_EQ(scored.size(), candidates.size());
    for (std::size_t i = 0; i < scored.size(); ++i) {
      ASSERT_EQ(scored[i].pose.matrix(), candidates[i].matrix());
      double expected = 0.0;
      if (in_free_space(candidates[i])) {
        const ViewEvaluation seen = uniform.evaluate(candidates[i], rays, object);
        EXPECT_EQ(scored[i].seen, seen);
        without_overlap += seen.unknown > 0 && seen.occupied < min_occupied ? 1U : 0U;
        if (seen.occupied >= min_occupied) {
          expected = static_cast<double>(seen.unknown) / (1.0 + distance_m(candidates[i]));
        }
      }
      EXPECT_DOUBLE_EQ(scored[i].utility, expected);
      useful += expected > 0.0 ? 1U : 0U;
      ++views;
    }
    const std::vector<ScoredView> on_threads = score_views(caster, candidates, rays, object, factors, 3);
    for (std::size_t i = 0; i < scored.size(); ++i) {
      EXPECT_EQ(on_threads[i].utility, scored[i].utility);
    }
  }
  EXPECT_EQ(views, 480U);
  EXPECT_GT(useful, 20U);
  EXPECT_GT(without_overlap, 20U);
}

TEST(ViewUtility, AFactorThatIsZeroSparesThoseAfterIt) {
  std::mt19937 engine(52);
  const OccupancyMap map = test::hollow_map(engine, 0.1);
  const RayCaster caster(map);
  const ViewRays rays(RangeSensor::pinhole(16, 12, 1.0, 0.8, 0.0, 5.0));
  const std::vector<Pose> candidates = random_views({{-1, -1, -1}, {1, 1, 1}}, 30, 3);
  int asked = 0;
  UtilityFactors factors;
  factors.registration = [&](const Pose& pose, const ViewEvaluation&) {
    return pose.translation().x() < 0 ? 0.0 : 1.0;
  };
  factors.surface = [&](const Pose& pose, const ViewEvaluation&) {
    ++asked;
    EXPECT_GE(pose.translation().x(), 0.0);
    return 2.0;
  };
  int kept = 0;
  for (const ScoredView& view : score_views(caster, candidates, rays, map.bounds(), factors)) {
    EXPECT_EQ(view.utility, view.pose.translation().x() < 0 ? 0.0 : 2.0);
    kept += view.utility > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(asked, kept);
  EXPECT_GT(kept, 5);
  EXPECT_LT(kept, 25);
}

}  // namespace
}  // namespace vantage
