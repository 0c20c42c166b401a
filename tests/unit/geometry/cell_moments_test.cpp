// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vantage/geometry/cell_moments.hpp>

namespace vantage {
namespace {

const VoxelFrame kLattice{0.1};

CellMoments moments_of(const std::vector<VoxelIndex>& cells, const VoxelIndex& origin) {
  CellMoments moments(origin);
  for (const VoxelIndex& cell : cells) {
    moments.add(cell);
  }
  return moments;
}

// Compares with sums over cell centres about their mean, for any origin and after any additions and removals.
TEST(CellMoments, AreTheMeanAndCovarianceOfSolidCells) {
  std::mt19937 engine(5);
  std::uniform_int_distribution<std::int32_t> coordinate(-300, 300);
  for (int round = 0; round < 200; ++round) {
    std::vector<VoxelIndex> cells(1 + engine() % 40);
    for (VoxelIndex& cell : cells) {
      cell = {coordinate(engine), coordinate(engine) / 10, coordinate(engine) / 100};
    }
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const VoxelIndex& cell : cells) {
      mean += Eigen::Vector3d(cell.x, cell.y, cell.z) / static_cast<double>(cells.size());
    }
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() / 12.0;
    for (const VoxelIndex& cell : cells) {
      const Eigen::Vector3d off = Eigen::Vector3d(cell.x, cell.y, cell.z) - mean;
      covariance += off * off.transpose() / static_cast<double>(cells.size());
    }
    CellMoments moments = moments_of(cells, {coordinate(engine), coordinate(engine), coordinate(engine)});
    const VoxelIndex passing{coordinate(engine), 7, 9};
    moments.add(passing);
    moments.remove(passing);
    EXPECT_EQ(moments.size(), cells.size());
    EXPECT_TRUE(moments.mean_cells().isApprox(mean, 1e-9));
    EXPECT_TRUE(moments.covariance_cells().isApprox(covariance, 1e-9));
  }
}

TEST(CellMoments, TheEllipsoidOfABallIsTheBall) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{-25, -25, -25}, {26, 26, 26}}, [&](const VoxelIndex& cell) {
    if (cell.x * cell.x + cell.y * cell.y + cell.z * cell.z <= 20 * 20) {
      cells.push_back(cell + VoxelIndex{3, 4, 5});
    }
  });
  const Ellipsoid ball = moments_of(cells, {}).ellipsoid(kLattice);
  EXPECT_TRUE(ball.centre_m.isApprox(kLattice.centre_of({3, 4, 5})));
  EXPECT_TRUE(ball.semi_axes_m.isApprox(Eigen::Vector3d::Constant(2.0), 0.005));
  EXPECT_NEAR(ball.volume_m3(), 1e-3 * static_cast<double>(cells.size()), 0.005 * ball.volume_m3());
}

TEST(Ellipsoid, LiesAlongItsCellsTheLongestAxisFirst) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{0, 0, 0}, {4, 20, 10}}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  const Ellipsoid box = moments_of(cells, {}).ellipsoid(kLattice);
  const double share = std::sqrt(5.0 / 12.0);  // of the side of a box, whose variance is side^2 / 12
  EXPECT_TRUE(box.semi_axes_m.isApprox(share * Eigen::Vector3d(2.0, 1.0, 0.4), 1e-9));
  EXPECT_NEAR(std::abs(box.axes(1, 0)), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(box.axes(2, 1)), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(box.axes(0, 2)), 1.0, 1e-9);
  const auto corners = box.corners();
  EXPECT_TRUE(corners[0].isApprox(Eigen::Vector3d(0.2, 1.0, 0.5)));
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector3d outwards = corners[i] - corners[0];
    EXPECT_TRUE(box.contains(corners[0] + 0.999 * outwards));
    EXPECT_FALSE(box.contains(corners[0] + 1.001 * outwards));
    EXPECT_NEAR(outwards.norm(), box.semi_axes_m[static_cast<Eigen::Index>((i - 1) / 2)], 1e-9);
  }
}

TEST(Ellipsoid, OneCellHasOne) {
  const Ellipsoid one = moments_of({{2, 3, 4}}, {2, 3, 4}).ellipsoid(kLattice);
  EXPECT_TRUE(one.centre_m.isApprox(kLattice.centre_of({2, 3, 4})));
  EXPECT_GT(one.volume_m3(), 1e-3);
  EXPECT_TRUE(one.contains(kLattice.centre_of({2, 3, 4})));
  EXPECT_FALSE(one.contains(kLattice.centre_of({3, 3, 4})));
}

}  // namespace
}  // namespace vantage
