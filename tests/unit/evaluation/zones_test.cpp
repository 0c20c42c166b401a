// SPDX-License-Identifier: MIT
#include "evaluation/zones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vantage/geometry/voxel_clusters.hpp>

namespace vantage {
namespace {

using detail::Zone;
using detail::ZoneKind;
using detail::Zones;

struct RandomSpace {
  VoxelBox box{{-3, 2, 0}, {11, 15, 5}};
  VoxelGrid<std::uint8_t> kinds{box};
  std::int32_t side = 4;

  explicit RandomSpace(std::mt19937& engine) {
    for_each_cell(box, [&](const VoxelIndex& cell) { kinds[cell] = static_cast<std::uint8_t>(engine() % 3); });
  }
  [[nodiscard]] Zones zones() const {
    return {VoxelFrame{0.5}, box, side, [&](const VoxelIndex& cell) { return static_cast<ZoneKind>(kinds[cell]); }};
  }
};

TEST(Zones, AreTheConnectedCellsOfAKindInEachBlock) {
  std::mt19937 engine(1);
  std::size_t checked = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const RandomSpace space(engine);
    const Zones zones = space.zones();
    std::map<std::tuple<int, int, int, int>, std::vector<VoxelIndex>> blocks;
    for_each_cell(space.box, [&](const VoxelIndex& cell) {
      const VoxelIndex at = cell - space.box.lo;
      if (space.kinds[cell] != 0) {
        blocks[{at.x / space.side, at.y / space.side, at.z / space.side, space.kinds[cell]}].push_back(cell);
      } else {
        EXPECT_EQ(zones.zone_of(cell), Zones::kNone);
      }
    });
    std::set<std::size_t> numbers;
    for (const auto& [key, cells] : blocks) {
      for (const std::vector<VoxelIndex>& cluster : voxel_clusters(cells, Connectivity::Face6)) {
        const std::size_t number = zones.zone_of(cluster.front());
        ASSERT_LT(number, zones.all().size());
        EXPECT_TRUE(numbers.insert(number).second);
        const Zone& zone = zones.all()[number];
        EXPECT_EQ(zone.cells, cluster.size());
        EXPECT_EQ(static_cast<int>(zone.kind), std::get<3>(key));
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const VoxelIndex& cell : cluster) {
          EXPECT_EQ(zones.zone_of(cell), number);
          sum += VoxelFrame{0.5}.centre_of(cell);
        }
        EXPECT_TRUE(zone.centre_m.isApprox(sum / static_cast<double>(cluster.size()), 1e-9));
        ++checked;
      }
    }
    EXPECT_EQ(numbers.size(), zones.all().size());
  }
  EXPECT_GT(checked, 1000U);
}

TEST(Zones, WaysThroughUnknownSpaceCountTwice) {
  std::mt19937 engine(2);
  for (int seed = 0; seed < 5; ++seed) {
    const RandomSpace space(engine);
    const Zones zones = space.zones();
    const std::size_t n = zones.all().size();
    std::vector<std::vector<double>> expected(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
    for_each_cell(space.box, [&](const VoxelIndex& cell) {
      for (const VoxelIndex& by : kFaceNeighbours) {
        const std::size_t a = zones.zone_of(cell);
        const std::size_t b = zones.zone_of(cell + by);
        if (a != Zones::kNone && b != Zones::kNone) {
          const bool both_free = space.kinds[cell] == 1 && space.kinds[cell + by] == 1;
          expected[a][b] =
              a == b ? 0.0 : (zones.all()[a].centre_m - zones.all()[b].centre_m).norm() * (both_free ? 1 : 2);
        }
      }
    });
    for (std::size_t i = 0; i < n; ++i) {
      expected[i][i] = 0.0;
    }
    for (std::size_t k = 0; k < n; ++k) {  // Floyd & Warshall 1962
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          expected[i][j] = std::min(expected[i][j], expected[i][k] + expected[k][j]);
        }
      }
    }
    for (std::size_t from = 0; from < n; from += 7) {
      const std::vector<double> found = zones.lengths_from(from);
      for (std::size_t to = 0; to < n; ++to) {
        if (std::isinf(expected[from][to])) {
          EXPECT_TRUE(std::isinf(found[to]));
        } else {
          EXPECT_NEAR(found[to], expected[from][to], 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace vantage
