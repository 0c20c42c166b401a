// SPDX-License-Identifier: MIT
#pragma once

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/octomap_bridge.hpp>
#include <vector>

#include <vantage/map/impl/octomap_file.hpp>
#include <vantage/map/impl/plain_stream.hpp>
#include <vantage/map/impl/whole_file.hpp>

namespace vantage {
namespace detail {

// Whether the log-odds of a free leaf mean the same in the map as in the tree that produced them.
enum class BeamModel : std::uint8_t { Same, Other };

inline BeamModel beam_model_of(const octomap::OcTree& tree, const OccupancyMapOptions& options) {
  constexpr double kRounding = 0.02;  // OctoMap stores probabilities: 0.4 becomes -0.405
  const bool same = std::abs(tree.getProbMissLog() - options.log_odds_miss) < kRounding &&
                    std::abs(tree.getClampingThresMinLog() - options.log_odds_min) < kRounding;
  return same ? BeamModel::Same : BeamModel::Other;
}

// A tree may use another threshold than 0, but its state must be kept. If a different beam model produced the tree,
// free log-odds are rounded to a whole number of our misses; otherwise every free cell would appear contested.
inline double log_odds_of(const OctomapLeaf& leaf, BeamModel model, const OccupancyMapOptions& options) {
  if (leaf.occupied) {
    return std::max(leaf.log_odds, 0.0);
  }
  if (model == BeamModel::Same && leaf.log_odds < 0.0) {
    return leaf.log_odds;
  }
  return std::max(1.0, std::round(leaf.log_odds / options.log_odds_miss)) * options.log_odds_miss;
}

inline VoxelBox box_of(const OctomapLeaf& leaf) {
  const std::int32_t edge = std::int32_t{1} << leaf.level;
  return {leaf.first, leaf.first + VoxelIndex{edge, edge, edge}};
}

inline void write_leaf(const OctomapLeaf& leaf, BeamModel model, OccupancyMap& map) {
  map.set_log_odds(box_of(leaf), log_odds_of(leaf, model, map.options()));
}

// Throws if the leaves stand for too many cells, so that a tree that is too large fails before anything is written.
template <class ForEachLeaf>
void check_leaves(const OctomapImportOptions& options, const std::string& what, const ForEachLeaf& for_each_leaf) {
  std::uint64_t cells = 0;
  for_each_leaf([&](const OctomapLeaf& leaf) {
    cells += leaf.cells();  // at most 2^48 in total, because leaves are disjoint
    if (cells > options.max_cells) {
      throw std::runtime_error(what + ": its leaves stand for more than " + std::to_string(options.max_cells) +
                               " finest cells (OctomapImportOptions::max_cells)");
    }
    if (std::isnan(leaf.log_odds)) {
      throw std::runtime_error(what + ": a node has log-odds that are not a number");
    }
  });
}

// Fills a new map from any object with `for_each_leaf(visit)`.
template <class ForEachLeaf>
OctomapImport import_leaves(double resolution_m, BeamModel model, const OctomapImportOptions& options,
                            const std::string& what, const ForEachLeaf& for_each_leaf) {
  OccupancyMapOptions map_options = options.map;
  map_options.resolution_m = resolution_m;
  OctomapImport import{OccupancyMap(map_options)};
  check_leaves(options, what, for_each_leaf);
  for_each_leaf([&](const OctomapLeaf& leaf) {
    write_leaf(leaf, model, import.map);
    const std::optional<double> held = import.map.log_odds(leaf.first);
    if (held && std::isfinite(leaf.log_odds)) {
      import.log_odds_rounding = std::max(import.log_odds_rounding, std::abs(*held - leaf.log_odds));
    }
  });
  return import;
}

inline VoxelIndex cell_of_key(const octomap::OcTreeKey& key) {
  return VoxelIndex{key[0], key[1], key[2]} - VoxelIndex{kOctomapReach, kOctomapReach, kOctomapReach};
}

inline octomap::OcTreeKey key_of(const VoxelIndex& cell) {
  const auto reachable = [](std::int32_t i) { return i >= -kOctomapReach && i < kOctomapReach; };
  if (!reachable(cell.x) || !reachable(cell.y) || !reachable(cell.z)) {
    throw std::invalid_argument("cell (" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ", " +
                                std::to_string(cell.z) + ") lies outside an OctoMap, which holds -32768 to 32767");
  }
  const auto key = [](std::int32_t i) { return static_cast<octomap::key_type>(i + kOctomapReach); };
  return {key(cell.x), key(cell.y), key(cell.z)};
}

template <class Visit>
void for_each_leaf_of(const octomap::OcTree& tree, const Visit& visit) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const int level = kOctomapDepth - static_cast<int>(leaf.getDepth());
    visit(OctomapLeaf{cell_of_key(leaf.getIndexKey()), level, leaf->getLogOdds(), tree.isNodeOccupied(*leaf)});
  }
}

// The log-odds of a tree, as the map is to hold them.
class OctreeLookup {
 public:
  OctreeLookup(const octomap::OcTree& tree, const OccupancyMapOptions& options)
      : tree_(tree), options_(options), model_(beam_model_of(tree, options)) {}

  [[nodiscard]] std::optional<double> log_odds(const VoxelIndex& cell) const {
    const octomap::OcTreeNode* node = tree_.search(key_of(cell));
    return node == nullptr ? std::nullopt
                           : std::optional(log_odds_of({cell, 0, node->getLogOdds(), tree_.isNodeOccupied(node)},
                                                       model_, options_));
  }

 private:
  const octomap::OcTree& tree_;
  const OccupancyMapOptions& options_;
  BeamModel model_;
};

enum class Keep : std::uint8_t { LogOdds, States };

inline std::unique_ptr<octomap::OcTree> make_octree(const OccupancyMap& map, Keep keep) {
  const OccupancyMapOptions& options = map.options();
  auto tree = std::make_unique<octomap::OcTree>(map.resolution_m());
  tree->setProbHit(octomap::probability(options.log_odds_hit));
  tree->setProbMiss(octomap::probability(options.log_odds_miss));
  tree->setClampingThresMin(octomap::probability(options.log_odds_min));
  tree->setClampingThresMax(octomap::probability(options.log_odds_max));
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    const double clamp = state == Occupancy::Occupied ? options.log_odds_max : options.log_odds_min;
    const double log_odds = keep == Keep::States ? clamp : map.log_odds(cell).value();
    tree->setNodeValue(key_of(cell), static_cast<float>(log_odds), true);
  });
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

// Replaces OctoMap's own writers, which round the resolution to six digits and print to stderr in debug builds.
class OctreeWriter {
 public:
  explicit OctreeWriter(const octomap::OcTree& tree) : tree_(tree) {}

  std::string write(Keep keep) {
    detail::PlainStream header;
    header.precision(17);
    header << "# Octomap OcTree " << (keep == Keep::States ? "binary " : "") << "file\n"
           << "# (the first line must stay as it is)\nid OcTree\nsize " << tree_.size() << "\nres "
           << tree_.getResolution() << "\ndata\n";
    bytes_ = header.str();
    if (const octomap::OcTreeNode* root = tree_.getRoot()) {
      keep == Keep::States ? write_states(*root) : write_log_odds(*root);
    }
    return std::move(bytes_);
  }

 private:
  const octomap::OcTreeNode* child(const octomap::OcTreeNode& node, unsigned index) const {
    return tree_.nodeChildExists(&node, index) ? tree_.getNodeChild(&node, index) : nullptr;
  }
  void write_states(const octomap::OcTreeNode& node) {
    unsigned states = 0;
    for (unsigned i = 0; i < 8; ++i) {
      if (const octomap::OcTreeNode* below = child(node, i)) {
        states |= (tree_.nodeHasChildren(below) ? 3U : tree_.isNodeOccupied(below) ? 2U : 1U) << (2 * i);
      }
    }
    bytes_.push_back(static_cast<char>(static_cast<unsigned char>(states & 0xFFU)));
    bytes_.push_back(static_cast<char>(static_cast<unsigned char>(states >> 8U)));
    for (unsigned i = 0; i < 8; ++i) {
      const octomap::OcTreeNode* below = child(node, i);
      if (below != nullptr && tree_.nodeHasChildren(below)) {
        write_states(*below);
      }
    }
  }
  void write_log_odds(const octomap::OcTreeNode& node) {
    const float log_odds = node.getLogOdds();
    char raw[sizeof log_odds];
    std::memcpy(raw, &log_odds, sizeof log_odds);
    bytes_.append(raw, sizeof log_odds);
    unsigned children = 0;
    for (unsigned i = 0; i < 8; ++i) {
      children |= tree_.nodeChildExists(&node, i) ? 1U << i : 0U;
    }
    bytes_.push_back(static_cast<char>(static_cast<unsigned char>(children)));
    for (unsigned i = 0; i < 8; ++i) {
      if (const octomap::OcTreeNode* below = child(node, i)) {
        write_log_odds(*below);
      }
    }
  }

  const octomap::OcTree& tree_;
  std::string bytes_;
};

}  // namespace detail

VANTAGE_INLINE OctomapImport load_octomap(const std::filesystem::path& path, const OctomapImportOptions& options) {
  const detail::OctomapFile file(path);
  return detail::import_leaves(
      file.resolution_m(), detail::BeamModel::Same, options, path.string(),
      [&](const std::function<void(const detail::OctomapLeaf&)>& visit) { file.for_each_leaf(visit); });
}

VANTAGE_INLINE void save_octomap(const OccupancyMap& map, const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension != ".bt" && extension != ".ot") {
    throw std::invalid_argument("save_octomap: " + path.string() + " must end in .bt or .ot");
  }
  const detail::Keep keep = extension == ".bt" ? detail::Keep::States : detail::Keep::LogOdds;
  detail::write_whole_file(path, detail::OctreeWriter(*detail::make_octree(map, keep)).write(keep));
}

VANTAGE_INLINE std::unique_ptr<octomap::OcTree> to_octree(const OccupancyMap& map) {
  return detail::make_octree(map, detail::Keep::LogOdds);
}

VANTAGE_INLINE OctomapImport from_octree(const octomap::OcTree& tree, const OctomapImportOptions& options) {
  return detail::import_leaves(tree.getResolution(), detail::beam_model_of(tree, options.map), options, "from_octree",
                               [&](const auto& visit) { detail::for_each_leaf_of(tree, visit); });
}

VANTAGE_INLINE OctomapFollower::OctomapFollower(octomap::OcTree& tree, const OctomapImportOptions& options)
    : tree_(tree), options_(options), follower_(from_octree(tree, options).map) {
  tree_.enableChangeDetection(true);
  tree_.resetChangeDetection();
}

VANTAGE_INLINE std::size_t OctomapFollower::update() {
  check_resolution();
  if (tree_.size() == 0) {
    return resync();
  }
  BrickSet cells;
  for (auto entry = tree_.changedKeysBegin(); entry != tree_.changedKeysEnd(); ++entry) {
    cells.insert(detail::cell_of_key(entry->first));
  }
  const std::size_t changed = follower_.update(detail::OctreeLookup(tree_, map().options()), cells);
  tree_.resetChangeDetection();
  return changed;
}

// Asks for all cells of the bricks that the map or the tree holds.
VANTAGE_INLINE std::size_t OctomapFollower::resync() {
  check_resolution();
  const auto for_each_leaf = [this](const auto& visit) { detail::for_each_leaf_of(tree_, visit); };
  detail::check_leaves(options_, "from_octree", for_each_leaf);
  BrickSet cells;
  const auto add = [&](const VoxelIndex& brick) { cells.plane(brick).fill(~std::uint64_t{0}); };
  map().for_each_brick([&](const VoxelIndex& brick, const Brick& /*cells*/) { add(brick); });
  for_each_leaf([&](const detail::OctomapLeaf& leaf) {
    const VoxelIndex last = detail::box_of(leaf).hi - VoxelIndex{1, 1, 1};
    for_each_cell(VoxelBox{Brick::of_cell(leaf.first), Brick::of_cell(last) + VoxelIndex{1, 1, 1}}, add);
  });
  const std::size_t changed = follower_.update(detail::OctreeLookup(tree_, map().options()), cells);
  tree_.resetChangeDetection();
  return changed;
}

VANTAGE_INLINE void OctomapFollower::check_resolution() const {
  if (tree_.getResolution() != map().resolution_m()) {
    std::ostringstream message;
    message << "OctomapFollower: the octree's resolution is now " << tree_.getResolution() << " m, the map's is "
            << map().resolution_m() << " m";
    throw std::runtime_error(message.str());
  }
}

}  // namespace vantage
