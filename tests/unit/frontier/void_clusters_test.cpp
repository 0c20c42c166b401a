// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>
#include <vantage/frontier/frontier_voids.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/geometry/cell_moments.hpp>
#include <vantage/geometry/raster_order.hpp>

#include "support/random_maps.hpp"

namespace vantage {
namespace {

using Cells = std::set<VoxelIndex, RasterOrder>;

const VoxelFrame kFrame{0.1};

std::vector<VoxelIndex> box(const VoxelIndex& lo, const VoxelIndex& hi) {
  std::vector<VoxelIndex> cells;
  for_each_cell({lo, hi}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  return cells;
}

std::vector<VoxelIndex> joined(std::vector<VoxelIndex> a, const std::vector<VoxelIndex>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Scans in a region with a closed chest. The corners of the region are occupied, so that the hull contains all of
/// it.
OccupancyMap random_map(std::mt19937& engine) {
  OccupancyMap map({.resolution_m = 0.1, .region = Box{{-0.8, -0.7, -0.6}, {0.9, 0.8, 0.7}}});
  for (int scan = 0; scan < 3; ++scan) {
    map.insert(test::random_scan(engine, 150));
  }
  for (const std::int32_t x : {-8, 8}) {
    for (const std::int32_t y : {-7, 7}) {
      map.set({x, y, -6}, Occupancy::Occupied);
      map.set({x, y, 6}, Occupancy::Occupied);
    }
  }
  const VoxelBox chest{{-5, -5, -5}, {-1, 0, -1}};
  map.set_log_odds(chest.grown(1), 1.0);
  for_each_cell(chest, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Unknown); });
  return map;
}

std::vector<VoxelIndex> random_voids(std::mt19937& engine) { return void_cells(random_map(engine)); }

/// Eq. 1 and 2 as written, over cell centres; the moments of solid cells are added at the end.
double score_of(const Cells& cells, FitScore kind) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const VoxelIndex& cell : cells) {
    mean += kFrame.centre_of(cell) / static_cast<double>(cells.size());
  }
  Eigen::Matrix3d sigma = kFrame.size_m * kFrame.size_m / 12.0 * Eigen::Matrix3d::Identity();
  for (const VoxelIndex& cell : cells) {
    const Eigen::Vector3d off = kFrame.centre_of(cell) - mean;
    sigma += off * off.transpose() / static_cast<double>(cells.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sigma);
  Ellipsoid ellipsoid{mean, solver.eigenvectors(), (5.0 * solver.eigenvalues()).cwiseSqrt()};
  double inside_m3 = 0.0;
  for (const VoxelIndex& cell : cells) {
    inside_m3 += ellipsoid.contains(kFrame.centre_of(cell)) ? std::pow(kFrame.size_m, 3) : 0.0;
  }
  return inside_m3 / (kind == FitScore::VolumeRatio ? ellipsoid.volume_m3()
                                                    : 4.0 / 3.0 * std::numbers::pi * solver.eigenvalues().prod());
}

Cells stepped_along(const Cells& region, const Cells& allowed, std::size_t axis) {
  Cells grown = region;
  for (const VoxelIndex& cell : region) {
    for (const VoxelIndex& step : {kFaceNeighbours[2 * axis], kFaceNeighbours[2 * axis + 1]}) {
      if (allowed.contains(cell + step)) {
        grown.insert(cell + step);
      }
    }
  }
  return grown;
}

/// The cluster grown from `start` in the remaining cells, with plain sets.
Cells grown_from(const VoxelIndex& start, const Cells& left, const VoidClusterOptions& options) {
  for (Cells region{start};;) {
    Cells grown = region;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grown = stepped_along(grown, left, axis);
    }
    if (grown == region || score_of(grown, options.score) < options.min_score) {
      return region;
    }
    region = grown;
  }
}

std::vector<Cells> members_of(const VoidClusters& voids, const std::vector<VoxelIndex>& cells) {
  std::vector<Cells> members(voids.clusters().size());
  for (const VoxelIndex& cell : cells) {
    members.at(voids.number_at(cell)).insert(cell);
  }
  return members;
}

TEST(VoidClusters, GrowAsTheDefinitionSaysCellByCell) {
  std::mt19937 engine(41);
  std::size_t clusters = 0;
  std::size_t large = 0;
  std::size_t cells_seen = 0;
  for (int round = 0; round < 16; ++round) {
    std::vector<VoxelIndex> cells = random_voids(engine);
    if (round % 2 == 1) {
      cells.push_back({100'000, -70'000, 5});  // a far cell, so that the bounding box is sparse
    }
    const VoidClusterOptions options{.score = round % 4 == 3 ? FitScore::Literal : FitScore::VolumeRatio,
                                     .min_score = round % 4 == 3 ? 3e4 : 0.4123 + 0.1 * (round % 3),
                                     .seed = engine()};
    const VoidClusters voids = cluster_void_cells(cells, kFrame, options);
    const std::vector<Cells> members = members_of(voids, cells);  // throws if a cell has no cluster
    Cells left(cells.begin(), cells.end());
    for (std::size_t i = 0; i < members.size(); ++i) {
      const VoidCluster& cluster = voids.clusters()[i];
      ASSERT_EQ(members[i], grown_from(cluster.start, left, options)) << "round " << round << ", cluster " << i;
      ASSERT_EQ(cluster.size, members[i].size());
      ASSERT_NEAR(cluster.score, score_of(members[i], options.score), 1e-6 * cluster.score);
      for (const VoxelIndex& cell : members[i]) {
        left.erase(cell);
      }
      ++clusters;
      large += members[i].size() > 50 ? 1U : 0U;
    }
    EXPECT_TRUE(left.empty());
    cells_seen += cells.size();
  }
  EXPECT_GT(clusters, 300U);
  EXPECT_GT(large, 20U);
  EXPECT_GT(cells_seen, 30'000U);
}

/// A hall with pillars and a wall across it, or with a slanted end, so that voids have many layers.
std::vector<VoxelIndex> random_hall(std::mt19937& engine) {
  const auto draw = [&](std::int32_t count) { return static_cast<std::int32_t>(engine() % 1000) % count; };
  std::vector<VoxelIndex> cells = box({}, {18 + draw(12), 10 + draw(8), 5 + draw(5)});
  for (int pillar = 0; pillar < 3; ++pillar) {
    const VoxelIndex lo{draw(30), draw(18), 0};
    const VoxelBox solid{lo, lo + VoxelIndex{1 + draw(3), 1 + draw(6), 12}};
    std::erase_if(cells, [&](const VoxelIndex& cell) { return solid.contains(cell); });
  }
  const std::int32_t slant = draw(2);
  std::erase_if(cells, [&](const VoxelIndex& cell) { return slant * cell.x + cell.y + cell.z > 26; });
  return cells;
}

TEST(VoidClusters, OfManyLayersGrowAsTheDefinitionSaysToo) {
  std::mt19937 engine(44);
  std::size_t large = 0;
  for (int round = 0; round < 12; ++round) {
    const std::vector<VoxelIndex> cells = random_hall(engine);
    const VoidClusterOptions options{.min_score = 0.45 + 0.08 * (round % 4), .seed = engine()};
    const VoidClusters voids = cluster_void_cells(cells, kFrame, options);
    const std::vector<Cells> members = members_of(voids, cells);
    Cells left(cells.begin(), cells.end());
    for (std::size_t i = 0; i < members.size(); ++i) {
      ASSERT_EQ(members[i], grown_from(voids.clusters()[i].start, left, options)) << "round " << round;
      ASSERT_NEAR(voids.clusters()[i].score, score_of(members[i], options.score), 1e-6);
      for (const VoxelIndex& cell : members[i]) {
        left.erase(cell);
      }
      large += members[i].size() > 400 ? 1U : 0U;
    }
  }
  EXPECT_GE(large, 10U);
}

TEST(VoidClusters, DependOnTheCellsAndTheSeedAlone) {
  std::mt19937 engine(42);
  std::size_t other_starts = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<VoxelIndex> cells = random_voids(engine);
    const VoidClusterOptions options{.seed = engine()};
    const VoidClusters once = cluster_void_cells(cells, kFrame, options);
    std::shuffle(cells.begin(), cells.end(), engine);
    cells.insert(cells.end(), cells.begin(), cells.begin() + 10);
    const VoidClusters again = cluster_void_cells(cells, kFrame, options);
    ASSERT_EQ(once.clusters().size(), again.clusters().size());
    for (const VoxelIndex& cell : cells) {
      ASSERT_EQ(once.number_at(cell), again.number_at(cell));
    }
    for (std::size_t i = 0; i < once.clusters().size(); ++i) {
      ASSERT_EQ(once.clusters()[i].ellipsoid.semi_axes_m, again.clusters()[i].ellipsoid.semi_axes_m);
    }
    const VoidClusters other = cluster_void_cells(cells, kFrame, {.seed = options.seed + 1});
    other_starts += other.clusters().front().start != once.clusters().front().start ? 1U : 0U;
  }
  EXPECT_GT(other_starts, 15U);
}

TEST(VoidClusters, ABoxIsOneWhateverItsSidesAndAnLIsNot) {
  for (const VoxelIndex& side : {VoxelIndex{20, 20, 20}, VoxelIndex{60, 12, 8}, VoxelIndex{7, 7, 40}}) {
    const VoidClusters voids = cluster_void_cells(box({}, side), kFrame, {.min_score = 0.7});
    ASSERT_EQ(voids.clusters().size(), 1U);
    EXPECT_NEAR(voids.clusters()[0].score, 0.789, 0.03);
  }
  const std::vector<VoxelIndex> l_shape = joined(box({0, 0, 0}, {40, 10, 10}), box({0, 10, 0}, {10, 40, 10}));
  EXPECT_GT(cluster_void_cells(l_shape, kFrame, {.min_score = 0.7}).clusters().size(), 1U);
  std::vector<VoxelIndex> ball = box({-20, -20, -20}, {21, 21, 21});
  std::erase_if(ball, [](const VoxelIndex& c) { return c.x * c.x + c.y * c.y + c.z * c.z > 400; });
  const VoidClusters round = cluster_void_cells(ball, kFrame, {.min_score = 0.4});
  ASSERT_EQ(round.clusters().size(), 1U);
  EXPECT_NEAR(round.clusters()[0].score, 1.0, 0.02);
}

TEST(VoidClusters, NeverReachThroughAWallNorAroundAnEdge) {
  const std::vector<VoxelIndex> cells = joined(box({0, 0, 0}, {5, 5, 5}), box({5, 5, 0}, {10, 10, 5}));
  const VoidClusters voids = cluster_void_cells(cells, kFrame, {.min_score = 1e-3});
  ASSERT_EQ(voids.clusters().size(), 2U);
  EXPECT_NE(voids.number_at({0, 0, 0}), voids.number_at({9, 9, 4}));
  EXPECT_EQ(voids.number_at({0, 9, 0}), VoidClusters::kNone);
  EXPECT_EQ(voids.number_at({100, 0, 0}), VoidClusters::kNone);
}

TEST(VoidClusters, OfNothingThereAreNone) {
  EXPECT_TRUE(cluster_void_cells({}, kFrame).clusters().empty());
  EXPECT_EQ(cluster_void_cells({}, kFrame).number_at({}), VoidClusters::kNone);
  EXPECT_THROW((void)cluster_void_cells({}, kFrame, {.min_score = 0.0}), std::invalid_argument);
}

TEST(FrontierVoids, AreTheVoidsThatAFrontierTouchesCellByCell) {
  std::mt19937 engine(43);
  std::size_t pairs = 0;
  std::size_t closed = 0;
  for (int round = 0; round < 20; ++round) {
    const OccupancyMap map = random_map(engine);
    const std::vector<VoxelIndex> cells = void_cells(map);
    const VoidClusters voids = cluster_void_cells(cells, map.frame(), {.min_score = 0.6, .seed = engine()});
    const auto frontier = frontier_clusters(frontier_cells(map), Connectivity::Face6);
    const auto touching = combine_frontier_voids(voids, frontier, FrontierShare::TouchingCells);
    const auto whole = combine_frontier_voids(voids, frontier, FrontierShare::WholeClusters);
    ASSERT_EQ(touching.size(), whole.size());
    const std::vector<Cells> members = members_of(voids, cells);
    std::size_t next = 0;
    for (std::uint32_t v = 0; v < members.size(); ++v) {
      std::vector<std::uint32_t> numbers;
      std::vector<VoxelIndex> beside;
      std::vector<VoxelIndex> all;
      for (std::uint32_t f = 0; f < frontier.size(); ++f) {
        const std::size_t before = beside.size();
        for (const VoxelIndex& cell : frontier[f]) {
          if (std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                          [&](const VoxelIndex& step) { return members[v].contains(cell + step); })) {
            beside.push_back(cell);
          }
        }
        if (beside.size() > before) {
          numbers.push_back(f);
          all = joined(all, frontier[f]);
        }
      }
      if (numbers.empty()) {
        ++closed;
        continue;
      }
      ASSERT_LT(next, touching.size());
      EXPECT_EQ(touching[next].cluster, v);
      EXPECT_EQ(touching[next].frontier_clusters, numbers);
      EXPECT_EQ(touching[next].frontier, beside);
      EXPECT_EQ(whole[next].frontier, all);
      EXPECT_EQ(touching[next].utility, members[v].size());
      pairs += beside.size();
      ++next;
    }
    EXPECT_EQ(next, touching.size());
  }
  EXPECT_GT(pairs, 3000U);
  EXPECT_GE(closed, 20U);
}

}  // namespace
}  // namespace vantage
