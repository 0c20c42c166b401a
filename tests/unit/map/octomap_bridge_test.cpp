// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vantage/map/octomap_bridge.hpp>

#include "support/random_maps.hpp"
#include "support/temporary_folder.hpp"

namespace vantage {
namespace {

using test::random_map;
using test::TemporaryFolder;

octomap::OcTreeKey key_of(const VoxelIndex& cell) {
  const auto key = [](std::int32_t i) { return static_cast<octomap::key_type>(i + 32768); };
  return {key(cell.x), key(cell.y), key(cell.z)};
}

template <class Tree>
Occupancy state_in(const Tree& tree, const VoxelIndex& cell) {
  const auto* node = tree.search(key_of(cell));
  return node == nullptr ? Occupancy::Unknown : tree.isNodeOccupied(node) ? Occupancy::Occupied : Occupancy::Free;
}

// Number of known cells of `tree`, counted leaf by leaf.
template <class Tree>
std::size_t known_cells(const Tree& tree) {
  std::size_t count = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    count += std::size_t{1} << (3 * (16 - leaf.getDepth()));
  }
  return count;
}

template <class Tree>
void expect_same_states(const OccupancyMap& map, const Tree& tree, std::size_t& compared) {
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    ASSERT_EQ(state_in(tree, cell), state);
    ++compared;
  });
  EXPECT_EQ(known_cells(tree), map.counts().free + map.counts().occupied);
}

enum class Compare { States, LogOdds };

void expect_same(const OccupancyMap& a, const OccupancyMap& b, Compare compare, std::size_t& compared) {
  EXPECT_DOUBLE_EQ(a.resolution_m(), b.resolution_m());
  EXPECT_EQ(a.counts().free, b.counts().free);
  EXPECT_EQ(a.counts().occupied, b.counts().occupied);
  a.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    ASSERT_EQ(b.at(cell), state);
    if (compare == Compare::LogOdds) {
      ASSERT_EQ(b.log_odds(cell), a.log_odds(cell));
    }
    ++compared;
  });
}

std::string message_of_load(const std::filesystem::path& path, const OctomapImportOptions& options = {}) {
  try {
    (void)load_octomap(path, options);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

TEST(OctomapBridge, ConvertsBothWaysWithoutLoss) {
  std::mt19937 engine(11);
  std::size_t compared = 0;
  for (int world = 0; world < 15; ++world) {
    const OccupancyMap map = random_map(engine);
    const auto tree = to_octree(map);
    expect_same_states(map, *tree, compared);
    const OctomapImport back = from_octree(*tree);
    expect_same(map, back.map, Compare::LogOdds, compared);
    EXPECT_LT(back.log_odds_rounding, 1e-6);
    EXPECT_NEAR(tree->getProbHitLog(), 0.85, 1e-6);
    EXPECT_NEAR(tree->getProbMissLog(), -0.4, 1e-6);
  }
  EXPECT_GT(compared, 100'000U);
}

TEST(OctomapBridge, WhatItSavesItLoads) {
  const TemporaryFolder folder;
  std::mt19937 engine(12);
  std::size_t compared = 0;
  for (const double resolution_m : {0.1, 1.0 / 30.0, 0.0125}) {
    const OccupancyMap map = random_map(engine, resolution_m);
    save_octomap(map, folder / "map.ot");
    save_octomap(map, folder / "map.bt");
    const OctomapImport log_odds = load_octomap(folder / "map.ot");
    EXPECT_EQ(log_odds.map.resolution_m(), resolution_m);
    EXPECT_LT(log_odds.log_odds_rounding, 1e-6);
    expect_same(map, log_odds.map, Compare::LogOdds, compared);
    expect_same(map, load_octomap(folder / "map.bt").map, Compare::States, compared);
  }
  EXPECT_GT(compared, 20'000U);
}

TEST(OctomapBridge, OctomapReadsWhatItSaves) {
  const TemporaryFolder folder;
  std::mt19937 engine(13);
  std::size_t compared = 0;
  for (int world = 0; world < 8; ++world) {
    const OccupancyMap map = random_map(engine);
    save_octomap(map, folder / "map.ot");
    save_octomap(map, folder / "map.bt");
    octomap::OcTree states(0.5);
    ASSERT_TRUE(states.readBinary((folder / "map.bt").string()));
    expect_same_states(map, states, compared);
    const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read((folder / "map.ot").string()));
    const auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
    ASSERT_NE(tree, nullptr);
    expect_same_states(map, *tree, compared);
    map.for_each_known([&](const VoxelIndex& cell, Occupancy) {
      ASSERT_NEAR(tree->search(key_of(cell))->getLogOdds(), map.log_odds(cell).value(), 1e-6);
    });
  }
  EXPECT_GT(compared, 50'000U);
}

// A tree as a host makes it, with OctoMap's own constants, which are not multiples of a step.
template <class Tree>
void fill_with_octomaps_constants(Tree& tree, std::mt19937& engine) {
  std::uniform_real_distribution<float> metre(-2.0F, 2.0F);
  for (int scan = 0; scan < 4; ++scan) {
    octomap::Pointcloud cloud;
    for (int i = 0; i < 150; ++i) {
      cloud.push_back(metre(engine), metre(engine), metre(engine));
    }
    tree.insertPointCloud(cloud, octomap::point3d(0.01F, 0.02F, 0.03F));
  }
}

TEST(OctomapBridge, ReadsWhatOctomapSaves) {
  const TemporaryFolder folder;
  std::mt19937 engine(14);
  std::size_t compared = 0;
  for (int world = 0; world < 8; ++world) {
    octomap::OcTree tree(0.1);
    fill_with_octomaps_constants(tree, engine);
    ASSERT_TRUE(tree.write((folder / "map.ot").string()));
    const OctomapImport import = load_octomap(folder / "map.ot");
    expect_same_states(import.map, tree, compared);
    EXPECT_GT(import.log_odds_rounding, 0.0);
    EXPECT_LT(import.log_odds_rounding, import.map.log_odds_step());
    expect_same(from_octree(tree).map, import.map, Compare::LogOdds, compared);
    ASSERT_TRUE(tree.writeBinary((folder / "map.bt").string()));
    expect_same(load_octomap(folder / "map.bt").map, import.map, Compare::States, compared);
  }
  EXPECT_GT(compared, 50'000U);
}

TEST(OctomapBridge, ReadsColouredTrees) {
  const TemporaryFolder folder;
  std::mt19937 engine(15);
  octomap::ColorOcTree tree(0.1);
  fill_with_octomaps_constants(tree, engine);
  tree.setNodeColor(key_of({3, 2, 1}), 10, 20, 30);
  ASSERT_TRUE(tree.write((folder / "colour.ot").string()));
  std::size_t compared = 0;
  expect_same_states(load_octomap(folder / "colour.ot").map, tree, compared);
  EXPECT_GT(compared, 5'000U);
}

TEST(OctomapBridge, AnEmptyMapIsAMapToo) {
  const TemporaryFolder folder;
  for (const char* name : {"empty.bt", "empty.ot"}) {
    save_octomap(OccupancyMap({.resolution_m = 0.2}), folder / name);
    const OctomapImport import = load_octomap(folder / name);
    EXPECT_DOUBLE_EQ(import.map.resolution_m(), 0.2);
    EXPECT_TRUE(import.map.bounds().empty());
  }
}

TEST(OctomapBridge, ATreesOwnThresholdDecidesWhatIsOccupied) {
  octomap::OcTree tree(0.1);
  tree.setOccupancyThres(0.7);
  tree.setNodeValue(key_of({1, 2, 3}), 0.4F);  // below the threshold: free
  tree.setNodeValue(key_of({1, 2, 4}), -0.001F);
  tree.setNodeValue(key_of({1, 2, 5}), 1.0F);
  const OctomapImport import = from_octree(tree);
  EXPECT_EQ(import.map.at({1, 2, 3}), Occupancy::Free);
  EXPECT_EQ(import.map.at({1, 2, 4}), Occupancy::Free);
  EXPECT_EQ(import.map.at({1, 2, 5}), Occupancy::Occupied);
  EXPECT_FALSE(import.map.contested({1, 2, 3}));
  EXPECT_NEAR(import.log_odds_rounding, 0.8, 1e-6);
}

// Scans of a wall in a tree with other constants: its free cells are not contested.
TEST(OctomapBridge, FreeCellsOfAnotherBeamModelAreNotContested) {
  octomap::OcTree tree(0.1);
  tree.setProbMiss(0.45);
  tree.setClampingThresMin(0.2);
  octomap::Pointcloud wall;
  for (float y = -1.0F; y < 1.0F; y += 0.05F) {
    wall.push_back(2.0F, y, 0.05F);
  }
  for (int scan = 0; scan < 3; ++scan) {
    tree.insertPointCloud(wall, octomap::point3d(0.05F, 0.05F, 0.05F));
  }
  const OctomapImport import = from_octree(tree);
  std::size_t free = 0;
  import.map.for_each_known([&](const VoxelIndex& cell, Occupancy occupancy) {
    free += occupancy == Occupancy::Free ? 1U : 0U;
  EXPECT_FALSE(import.map.contested(cell));
});
EXPECT_GT(free, 100U);
}  // namespace

TEST(OctomapBridge, ImportsOnlyTheRegion) {
  std::mt19937 engine(16);
  const auto tree = to_octree(random_map(engine));
  const Box region{{-2.5, -2.5, -2.5}, {2.0, 2.5, 2.5}};
  const OctomapImport import = from_octree(*tree, {.map = {.region = region}});
  std::size_t known = 0;
  for_each_cell({{-60, -60, -60}, {60, 60, 60}}, [&](const VoxelIndex& cell) {
    const bool inside = region.contains(import.map.frame().centre_of(cell));
    ASSERT_EQ(import.map.at(cell), inside ? state_in(*tree, cell) : Occupancy::Unknown);
    known += import.map.at(cell) != Occupancy::Unknown ? 1U : 0U;
  });
  EXPECT_GT(known, 500U);
}

TEST(OctomapBridge, HoldsOctomapsWholeReachAndNamesACellBeyond) {
  OccupancyMap map({.resolution_m = 0.1});
  map.set({-32768, 32767, 0}, Occupancy::Occupied);
  EXPECT_EQ(from_octree(*to_octree(map)).map.at({-32768, 32767, 0}), Occupancy::Occupied);
  map.set({0, 32768, -1}, Occupancy::Free);
  try {
    (void)to_octree(map);
    FAIL() << "must refuse";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("cell (0, 32768, -1)"), std::string::npos) << error.what();
  }
}

TEST(OctomapBridge, NamesTheFileAndWhatIsWrong) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "map.bt";
  const auto complains = [&](const std::string& bytes, const std::string& about) {
    write_bytes(path, bytes);
    const std::string message = message_of_load(path);
    EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
    EXPECT_NE(message.find(about), std::string::npos) << message << " should say: " << about;
  };
  EXPECT_EQ(message_of_load(path), path.string() + ": no such file");
  EXPECT_NE(message_of_load(path.parent_path()).find("cannot be read"), std::string::npos);
  complains("", "is not an OctoMap file");
  complains("ply\nformat ascii 1.0\n", "is not an OctoMap file");
  complains("# Octomap OcTree file", "ends within its header");
  complains("# Octomap OcTree file\nid OcTree\nsize 1\nres 0.1\n", "ends within its header");
  const std::string head = "# Octomap OcTree binary file\n";
  complains(head + "id Quadtree\nsize 1\nres 0.1\ndata\n", "\"Quadtree\"");
  complains(head + "id OcTree\nsize -1\nres 0.1\ndata\n", "node count \"-1\"");
  complains(head + "id OcTree\nsize 99999999999999999999999\nres 0.1\ndata\n", "node count");
  complains(head + "id OcTree\nres 0.1\ndata\n", "node count \"\"");
  complains(head + "id OcTree\nsize 1\nres nan\ndata\n", "resolution \"nan\"");
  complains(head + "id OcTree\nsize 1\nres -0.1\ndata\n", "resolution \"-0.1\"");
  complains(head + "id OcTree\nsize 1\nres 0\ndata\n", "resolution \"0\"");
  complains(head + "id OcTree\nsize 2\nres 0.1\ndata\n", "ends within node 1 of 2");
  complains(head + "id OcTree\nsize 1000000000000\nres 0.1\ndata\n", "ends within node 1");
  complains(head + "id OcTree\nsize 1\nres 0.1\ndata\n" + std::string(2, '\0'), "no children");
  complains(head + "id OcTree\nsize 50\nres 0.1\ndata\n" + std::string(40, '\x03'), "node 17");
  // One free leaf below the root: an eighth of all cells.
  complains(head + "id OcTree\nsize 2\nres 0.1\ndata\n" + std::string("\x01\x00", 2), "max_cells");
  complains(head + "id OcTree\nsize 0\nres 0.1\ndata\nx", "1 bytes follow the last node");

  OccupancyMap map;
  map.set({1, 2, 3}, Occupancy::Free);
  save_octomap(map, path);
  const std::string good = read_bytes(path);
  complains(good.substr(0, good.size() - 1), "cut short");
  std::string other = good;
  other.replace(other.find("size 17"), 7, "size 18");
  complains(other, "holds 17 nodes, its header says 18");
  EXPECT_THROW(save_octomap(map, folder / "map.png"), std::invalid_argument);
  EXPECT_THROW(save_octomap(map, folder / "nowhere/map.bt"), std::runtime_error);
}

TEST(OctomapBridge, DamagedFilesThrowOrLoadAndNeverCrash) {
  const TemporaryFolder folder;
  std::mt19937 engine(17);
  std::size_t thrown = 0;
  std::size_t loaded = 0;
  const OctomapImportOptions small{.max_cells = 100'000};
  for (const char* name : {"map.bt", "map.ot"}) {
    OccupancyMap map({.resolution_m = 0.1});
    map.insert(test::random_scan(engine, 20));
    save_octomap(map, folder / name);
    const std::string good = read_bytes(folder / name);
    const auto attempt = [&](const std::string& bytes) {
      write_bytes(folder / name, bytes);
      try {
        loaded += load_octomap(folder / name, small).map.counts().free < 100'000U ? 1U : 0U;
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).rfind((folder / name).string(), 0), 0U) << error.what();
        ++thrown;
      }
    };
    std::uniform_int_distribution<std::size_t> position(0, good.size() - 1);
    std::uniform_int_distribution<int> bit(0, 7);
    const std::size_t before = thrown;
    for (int variant = 0; variant < 400; ++variant) {
      attempt(good.substr(0, position(engine)));
    }
    EXPECT_EQ(thrown - before, 400U) << "every truncated file must be noticed";
    for (int variant = 0; variant < 1600; ++variant) {
      std::string bytes = good;
      for (int flip = 0; flip <= variant % 4; ++flip) {
        char& byte = bytes[variant % 3 == 0 ? position(engine) % 150 : position(engine)];
        byte = static_cast<char>(byte ^ (1 << bit(engine)));
      }
      attempt(bytes);
    }
  }
  EXPECT_EQ(thrown + loaded, 4000U);
  EXPECT_GT(loaded, 100U);
}

TEST(OctomapFollower, KeepsTheStatesOfALiveTree) {
  std::mt19937 engine(18);
  std::uniform_int_distribution<std::int32_t> coordinate(-20, 20);
  std::size_t compared = 0;
  std::size_t changed = 0;
  for (int world = 0; world < 6; ++world) {
    octomap::OcTree tree(0.1);
    if (world % 2 == 1) {
      fill_with_octomaps_constants(tree, engine);
    }
    OctomapFollower follower(tree);
    for (int step = 0; step < 8; ++step) {
      const OccupancyMap before = follower.map();
      if (step == 5 && world == 3) {
        tree.clear();
      } else if (step % 3 == 2) {
        for (int i = 0; i < 200; ++i) {
          tree.updateNode(key_of({coordinate(engine), coordinate(engine), coordinate(engine)}), i % 2 == 0);
        }
      } else {
        fill_with_octomaps_constants(tree, engine);
      }
      const std::size_t reported = follower.update();
      expect_same_states(follower.map(), tree, compared);
      std::size_t differing = 0;
      const auto count = [&](const VoxelIndex& cell) {
        differing += before.at(cell) != follower.map().at(cell) ? 1U : 0U;
      };
      follower.map().for_each_known([&](const VoxelIndex& cell, Occupancy) { count(cell); });
      before.for_each_known([&](const VoxelIndex& cell, Occupancy) {
        differing += follower.map().at(cell) == Occupancy::Unknown ? 1U : 0U;
      });
      EXPECT_EQ(reported, differing);
      changed += reported;
      EXPECT_EQ(follower.update(), 0U);
    }
    EXPECT_EQ(follower.resync(), 0U);
    expect_same(from_octree(tree).map, follower.map(), Compare::LogOdds, compared);
  }
  EXPECT_GT(compared, 200'000U);
  EXPECT_GT(changed, 20'000U);
}

TEST(OctomapFollower, TellsItsReadersWhatChanged) {
  octomap::OcTree tree(0.1);
  OctomapFollower follower(tree);
  tree.updateNode(key_of({0, 0, 0}), false);
  tree.updateNode(key_of({100, 0, 0}), true);
  EXPECT_EQ(follower.update(), 2U);
  const OccupancyMap::Revision then = follower.map().revision();
  tree.updateNode(key_of({0, 1, 0}), false);
  EXPECT_EQ(follower.update(), 1U);
  EXPECT_EQ(follower.map().changed_since(then), std::vector<VoxelIndex>{VoxelIndex{}});
}

TEST(OctomapFollower, AFullMapKeepsWhatItHasHadRoomFor) {
  std::mt19937 engine(11);
  octomap::OcTree tree(0.1);
  const auto grow = [&](int cells) {
    for (int i = 0; i < cells; ++i) {
      const auto coordinate = [&] { return static_cast<std::int32_t>(engine() % 160) - 80; };
      tree.updateNode(key_of({coordinate(), coordinate(), coordinate()}), engine() % 3 == 0);
    }
  };
  grow(40);
  OctomapFollower follower(tree, {.map = {.max_bytes = 120'000}});
  EXPECT_EQ(follower.map().cells_refused(), 0U);
  std::size_t known = 0;
  for (int step = 0; step < 20; ++step) {
    grow(40);
    follower.update();
    std::size_t now = 0;
    follower.map().for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      EXPECT_EQ(state, state_in(tree, cell));
      ++now;
    });
    EXPECT_GE(now, known);
    EXPECT_EQ(follower.resync(), 0U) << "nothing that is known may be lost, and nothing else fits";
    EXPECT_LE(follower.map().memory_bytes(), 120'000U);
    known = now;
  }
  EXPECT_GT(follower.map().cells_refused(), 100U);
  EXPECT_GT(known, 60U);
  // An edit that change detection misses, in a cell that the map holds.
  VoxelIndex held{};
  follower.map().for_each_known([&](const VoxelIndex& cell, Occupancy) { held = cell; });
  const bool was_free = follower.map().at(held) == Occupancy::Free;
  tree.search(key_of(held))->setLogOdds(was_free ? 3.0F : -2.0F);
  EXPECT_EQ(follower.resync(), 1U);
  EXPECT_EQ(follower.map().at(held), was_free ? Occupancy::Occupied : Occupancy::Free);
  const OctomapImport import = from_octree(tree, {.map = {.max_bytes = 120'000}});
  EXPECT_LE(import.map.memory_bytes(), 120'000U);
  EXPECT_EQ(import.map.counts().free + import.map.counts().occupied + import.map.cells_refused(), known_cells(tree));
}

TEST(OctomapFollower, ResyncSeesWhatChangeDetectionMissesAndAnotherResolutionIsRefused) {
  octomap::OcTree tree(0.1);
  tree.updateNode(key_of({0, 0, 0}), false);
  tree.updateNode(key_of({50, 0, 0}), true);
  tree.updateNode(key_of({51, 0, 0}), true);
  OctomapFollower follower(tree);
  tree.deleteNode(key_of({51, 0, 0}));
  EXPECT_EQ(follower.update(), 0U);
  EXPECT_EQ(follower.resync(), 1U);
  EXPECT_EQ(follower.map().at({51, 0, 0}), Occupancy::Unknown);
  tree.clear();
  tree.setResolution(0.2);
  EXPECT_THROW(follower.update(), std::runtime_error);
}

}  // namespace vantage
}  // namespace vantage
