// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vantage/geometry/voxel_ray.hpp>
#include <vector>

namespace vantage {
namespace {

// Many segments connect cell centres and pass exactly through edges and corners. There, a ray with exchanged ends
// visits other cells, but all_from_the_end must not.
TEST(VoxelRay, FromTheEndPassesTheSameCellsBackwards) {
  const VoxelFrame frame{0.2};
  std::mt19937 engine(5);
  const auto draw = [&](std::uint32_t sides) { return static_cast<std::int32_t>(engine() % sides); };
  std::size_t walked = 0;
  std::size_t exchanged_differs = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool centres = i % 2 == 0;
    const auto point = [&] {
      const VoxelIndex cell{draw(19) - 9, draw(19) - 9, draw(19) - 9};
      Eigen::Vector3d at = frame.centre_of(cell);
      if (!centres) {
        at += 0.0009 * Eigen::Vector3d(draw(200) - 100, draw(200) - 100, draw(200) - 100);
      }
      return at;
    };
    const Eigen::Vector3d from = point();
    const Eigen::Vector3d to = point();
    const VoxelRay ray(frame, from, to);
    std::vector<VoxelIndex> forwards;
    for (const VoxelIndex& cell : ray) {
      forwards.push_back(cell);
    }
    std::vector<VoxelIndex> backwards;
    ASSERT_TRUE(ray.all_from_the_end([&](const VoxelIndex& cell) {
      backwards.push_back(cell);
      return true;
    }));
    walked += backwards.size();
    std::vector<VoxelIndex> exchanged;
    for (const VoxelIndex& cell : VoxelRay(frame, to, from)) {
      exchanged.push_back(cell);
    }
    exchanged_differs += exchanged == backwards ? 0U : 1U;
    std::reverse(backwards.begin(), backwards.end());
    ASSERT_EQ(forwards, backwards) << i;

    const VoxelIndex& refused = forwards[forwards.size() / 2];
    std::size_t asked = 0;
    EXPECT_FALSE(ray.all_from_the_end([&](const VoxelIndex& cell) {
      ++asked;
      return cell != refused;
    }));
    EXPECT_EQ(asked, forwards.size() - forwards.size() / 2);
  }
  EXPECT_GT(walked, 200000U);
  EXPECT_GT(exchanged_differs, 100U);
}

// The cells whose closed box the segment meets, by definition. Centres are joined exactly through edges and corners.
TEST(VoxelRay, TouchesAllCellsAroundAnEdge) {
  const VoxelFrame frame{0.2};
  std::mt19937 engine(6);
  const auto draw = [&](std::uint32_t sides) { return static_cast<std::int32_t>(engine() % sides); };
  std::size_t touched = 0;
  std::size_t beside = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto point = [&] {
      Eigen::Vector3d at = frame.centre_of({draw(9) - 4, draw(9) - 4, draw(9) - 4});
      if (i % 2 != 0) {
        at += 0.0009 * Eigen::Vector3d(draw(200) - 100, draw(200) - 100, draw(200) - 100);
      }
      return at;
    };
    const Eigen::Vector3d from = point();
    const Eigen::Vector3d to = point();
    const auto meets = [&](const VoxelIndex& cell) {
      const Box box = frame.box_of(cell);
      double enters = 0.0;
      double leaves = 1.0;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double length_m = to[axis] - from[axis];
        const double a = box.min[axis] - 1e-9 - from[axis];
        const double b = box.max[axis] + 1e-9 - from[axis];
        if (length_m == 0.0) {
          enters = a > 0.0 || b < 0.0 ? 2.0 : enters;
          continue;
        }
        enters = std::max(enters, std::min(a / length_m, b / length_m));
        leaves = std::min(leaves, std::max(a / length_m, b / length_m));
      }
      return enters <= leaves;
    };
    std::set<VoxelIndex> expected;
    for_each_cell({{-6, -6, -6}, {7, 7, 7}}, [&](const VoxelIndex& cell) {
      if (meets(cell)) {
        expected.insert(cell);
      }
    });
    std::vector<VoxelIndex> cells;
    const VoxelRay ray(frame, from, to);
    ASSERT_TRUE(ray.all_touched([&](const VoxelIndex& cell) {
      cells.push_back(cell);
      return true;
    }));
    ASSERT_EQ(std::set<VoxelIndex>(cells.begin(), cells.end()), expected) << i;
    ASSERT_EQ(cells.size(), expected.size()) << "each once";
    touched += cells.size();
    beside += cells.size() - static_cast<std::size_t>(ray.size());
    const VoxelIndex refused = cells[cells.size() / 2];
    EXPECT_FALSE(ray.all_touched([&](const VoxelIndex& cell) { return cell != refused; }));
  }
  EXPECT_GT(touched, 40000U);
  EXPECT_GT(beside, 2000U);
}

}  // namespace
}  // namespace vantage
