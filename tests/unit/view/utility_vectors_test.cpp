// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <support/hollow_map.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/view/utility_vectors.hpp>

namespace vantage {
namespace {

struct Scene {
  explicit Scene(std::mt19937& engine) : map(test::hollow_map(engine, 0.1)) {
    map.set_log_odds(VoxelBox{{-3, -3, -3}, {4, 4, 4}}, -2.0);
    voids = cluster_void_cells(void_cells(map), map.frame(), {.seed = engine()});
    frontier_voids = combine_frontier_voids(voids, frontier_clusters(frontier_cells(map)));
  }

  OccupancyMap map;
  VoidClusters voids;
  std::vector<FrontierVoid> frontier_voids;
};

TEST(UtilityVectors, LeadFromEveryCornerOfAVoidThroughItsFrontier) {
  std::mt19937 engine(61);
  std::size_t checked = 0;
  for (int round = 0; round < 3; ++round) {
    const Scene scene(engine);
    const VoxelFrame& frame = scene.map.frame();
    const std::vector<UtilityVector> vectors = utility_vectors(scene.voids, scene.frontier_voids, frame, 1U << 30U);
    std::size_t next = 0;
    for (const FrontierVoid& one : scene.frontier_voids) {
      const Ellipsoid& ellipsoid = scene.voids.clusters()[one.cluster].ellipsoid;
      for (const VoxelIndex& cell : one.frontier) {
        for (const Eigen::Vector3d& corner : ellipsoid.corners()) {
          const Eigen::Vector3d line = frame.centre_of(cell) - corner;
          if (line.norm() > 0.0) {
            ASSERT_LT(next, vectors.size());
            EXPECT_EQ(vectors[next].frontier, cell);
            EXPECT_EQ(vectors[next].utility, one.utility);
            EXPECT_TRUE((line.norm() * vectors[next].direction).isApprox(line, 1e-12));
            ++next;
          }
        }
      }
    }
    EXPECT_EQ(next, vectors.size());
    checked += next;
  }
  EXPECT_GT(checked, 10'000U);
}

TEST(UtilityVectors, AreThinnedEvenlyWhereTheyAreTooMany) {
  std::mt19937 engine(62);
  const Scene scene(engine);
  const VoxelFrame& frame = scene.map.frame();
  const auto total = [](const std::vector<UtilityVector>& vectors) {
    return std::accumulate(vectors.begin(), vectors.end(), 0.0, [](double sum, const UtilityVector& one) {
      return sum + static_cast<double>(one.utility);
    });
  };
  const std::vector<UtilityVector> all = utility_vectors(scene.voids, scene.frontier_voids, frame);
  ASSERT_GT(all.size(), 5000U);
  for (const std::size_t most : {all.size(), all.size() - 1, all.size() / 2, all.size() / 5}) {
    const std::vector<UtilityVector> some = utility_vectors(scene.voids, scene.frontier_voids, frame, most);
    EXPECT_LE(some.size(), most + 7 * scene.frontier_voids.size());
    EXPECT_NEAR(total(some) / total(all), 1.0, 0.1);
  }
  EXPECT_EQ(utility_vectors(scene.voids, scene.frontier_voids, frame, all.size()).size(), all.size());
  EXPECT_THROW((void)utility_vectors(scene.voids, scene.frontier_voids, frame, 0), std::invalid_argument);
}

// Compares with the cells of each line, one by one.
TEST(AccumulatedUtility, IsWhatTheLinesThroughACellAreWorth) {
  std::mt19937 engine(63);
  const FreeFlyer flyer({.radius_m = 0.1});
  constexpr double kMin = 0.35;
  constexpr double kMax = 2.0;
  std::size_t useful = 0;
  for (int round = 0; round < 3; ++round) {
    const Scene scene(engine);
    const OccupancyMap& map = scene.map;
    const VoxelFrame& frame = map.frame();
    const ReachableSpace reachable(map, flyer, pose_looking({0.05, 0.05, 0.05}, 0.0));
    ASSERT_TRUE(reachable.start());
    const std::vector<UtilityVector> vectors = utility_vectors(scene.voids, scene.frontier_voids, frame, 20'000);
    std::map<VoxelIndex, std::uint64_t, RasterOrder> expected;
    std::uint64_t operations = 0;
    for (const UtilityVector& vector : vectors) {
      const Eigen::Vector3d from = frame.centre_of(vector.frontier);
      std::vector<VoxelIndex> line;
      for (const VoxelIndex& cell : VoxelRay(frame, from, from + kMax * vector.direction)) {
        line.push_back(cell);
      }
      for (const VoxelIndex& cell : line) {
        ++operations;
        if (map.at(cell) != Occupancy::Free) {
          break;
        }
        if (reachable.contains(cell) && (frame.centre_of(cell) - from).norm() >= kMin) {
          expected[cell] += vector.utility;
        }
      }
    }
    const AccumulatedUtility utility = accumulate_utility(map, reachable, vectors, kMin, kMax);
    ASSERT_EQ(utility.cells, (std::vector<std::pair<VoxelIndex, std::uint64_t>>(expected.begin(), expected.end())));
    EXPECT_EQ(utility.operations, operations);
    useful += expected.size();
  }
  EXPECT_GT(useful, 5'000U);
}

}  // namespace
}  // namespace vantage
