// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vantage/field/laplace_multigrid.hpp>
#include <vantage/field/sink_flux.hpp>

#include "random_laplace.hpp"

namespace vantage {
namespace {

double total_flux(const std::vector<SinkCluster>& clusters) {
  double sum = 0.0;
  for (const SinkCluster& cluster : clusters) {
    sum += cluster.flux;
  }
  return sum;
}

// What leaves the source arrives at the sinks, with the uniform source on top: a ten-thousandth of it.
TEST(SinkFlux, WhatLeavesTheSourceArrivesAtTheSinks) {
  std::mt19937 engine(61);
  std::size_t compared = 0;
  std::size_t clusters_met = 0;
  for (int world = 0; world < 300; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine, 10).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    for (const double uniform_source : {0.0, 1e-4}) {
      const LaplaceMultigrid field(problem, {.tolerance = 1e-12, .uniform_source = uniform_source});
      const std::vector<double> phi = field.values(problem);
      const std::vector<SinkCluster> clusters = sink_clusters(problem, phi);
      std::size_t sinks = 0;
      for (const SinkCluster& cluster : clusters) {
        EXPECT_GE(cluster.flux, -1e-9);  // rounding, where all but nothing flows
        sinks += cluster.sinks.size();
      }
      EXPECT_EQ(sinks, problem.sink_count());
      const double left = source_flux(problem, phi);
      EXPECT_GT(left, 0.0);
      EXPECT_NEAR(total_flux(clusters), (1.0 + uniform_source) * left, (1e-9 + uniform_source) * left);
      clusters_met += clusters.size();
      ++compared;
    }
  }
  EXPECT_GE(compared, 300U);
  EXPECT_GT(clusters_met, compared + compared / 2) << "most have more than one";
}

// A corridor of a single cell, sinks at both ends: each draws as its way is short.
TEST(SinkFlux, TheNearerEndDrawsMore) {
  std::vector<VoxelIndex> cells;
  for (std::int32_t x = 0; x <= 10; ++x) {
    cells.push_back({x, 0, 0});
  }
  const std::vector<VoxelIndex> ends{{0, 0, 0}, {10, 0, 0}};
  const LaplaceProblem problem(cells, ends, {2, 0, 0});
  const LaplaceMultigrid field(problem, {.uniform_source = 0.0});
  const std::vector<SinkCluster> clusters = sink_clusters(problem, field.values(problem));
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_NEAR(clusters[0].flux, 1.0 / 2.0, 1e-6);
  EXPECT_NEAR(clusters[1].flux, 1.0 / 8.0, 1e-6);
}

// Cells that touch at an edge are one boundary, and what it draws counts together.
TEST(SinkFlux, SinksThatTouchAreOne) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{0, 0, 0}, {9, 9, 1}}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  const std::vector<VoxelIndex> sinks{{8, 3, 0}, {8, 4, 0}, {7, 5, 0}, {0, 0, 0}};
  const LaplaceProblem problem(cells, sinks, {4, 4, 0});
  const LaplaceMultigrid field(problem);
  const std::vector<SinkCluster> clusters = sink_clusters(problem, field.values(problem));
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[0].sinks, std::vector<VoxelIndex>({{0, 0, 0}}));
  EXPECT_EQ(clusters[1].sinks.size(), 3U);
  EXPECT_GT(clusters[1].flux, clusters[0].flux);
}

TEST(SinkFlux, RefusesAFieldOfAnotherSize) {
  const std::vector<VoxelIndex> cells{{0, 0, 0}, {1, 0, 0}};
  const std::vector<VoxelIndex> sinks{{1, 0, 0}};
  const LaplaceProblem problem(cells, sinks, {0, 0, 0});
  const std::vector<double> phi(3, 0.0);
  EXPECT_THROW((void)sink_clusters(problem, phi), std::invalid_argument);
  EXPECT_THROW((void)source_flux(problem, phi), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
