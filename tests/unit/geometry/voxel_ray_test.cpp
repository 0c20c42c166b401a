// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
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

}  // namespace
}  // namespace vantage
