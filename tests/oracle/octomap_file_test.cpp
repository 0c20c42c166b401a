// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <vantage/frontier/frontiers.hpp>
#include <vantage/map/octomap_bridge.hpp>

#include "support/real_data.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

TEST(OctomapFile, ARealBuildingComesBackCellByCell) {
  VANTAGE_REAL_DATA(path, "octomaps/geb079.bt");
  const test::TemporaryFolder folder;
  const OccupancyMap map = load_octomap(path).map;
  EXPECT_EQ(map.counts().free, 950'759U);
  EXPECT_DOUBLE_EQ(map.resolution_m(), 0.08);

  octomap::OcTree tree(0.1);
  ASSERT_TRUE(tree.readBinary(path.string()));
  std::size_t in_tree = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const std::int32_t edge = 1 << (16 - leaf.getDepth());
    const octomap::OcTreeKey key = leaf.getIndexKey();
    const VoxelIndex lo{key[0] - 32768, key[1] - 32768, key[2] - 32768};
    const Occupancy expected = tree.isNodeOccupied(*leaf) ? Occupancy::Occupied : Occupancy::Free;
    for_each_cell({lo, lo + VoxelIndex{edge, edge, edge}}, [&](const VoxelIndex& cell) {
      ASSERT_EQ(map.at(cell), expected);
      ++in_tree;
    });
  }
  EXPECT_EQ(in_tree, map.counts().free + map.counts().occupied);

  for (const char* name : {"again.bt", "again.ot"}) {
    save_octomap(map, folder / name);
    const OctomapImport again = load_octomap(folder / name);
    EXPECT_EQ(again.map.counts().free, map.counts().free);
    EXPECT_EQ(again.map.counts().occupied, map.counts().occupied);
    map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      ASSERT_EQ(again.map.at(cell), state);
      ASSERT_EQ(again.map.log_odds(cell), map.log_odds(cell));
    });
  }
  octomap::OcTree reread(0.1);
  ASSERT_TRUE(reread.readBinary((folder / "again.bt").string()));
  EXPECT_TRUE(reread == tree) << "node by node as the original";
}

TEST(OctomapFile, ARealBuildingHasTheKnownFrontier) {
  VANTAGE_REAL_DATA(path, "octomaps/geb079.bt");
  const OccupancyMap map = load_octomap(path).map;
  const std::vector<VoxelIndex> cells = frontier_cells(map);
  EXPECT_EQ(cells.size(), 188'596U);
  EXPECT_EQ(count_frontier_cells(map), 188'596U);
  std::size_t in_clusters = 0;
  for (const auto& cluster : frontier_clusters(cells)) {
    in_clusters += cluster.size();
  }
  EXPECT_EQ(in_clusters, cells.size());
}

}  // namespace
}  // namespace vantage
