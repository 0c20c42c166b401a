// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace octomap {
class OcTree;
}

namespace VANTAGE_EXPORT vantage {

/// How an octree becomes an OccupancyMap.
struct OctomapImportOptions {
  /// The map to make; its `resolution_m` is not used: the octree brings its own. An `.ot` does not name the beam
  /// model that made it: give the constants of its maker here, or its free cells may look contested
  /// (OccupancyMap::contested). An octree in memory names its own; where it differs, free cells come in as the
  /// nearest whole number of misses.
  OccupancyMapOptions map = {};
  /// Refuse an octree whose leaves, expanded to finest cells, are more than this: one leaf near the root of a damaged
  /// file would otherwise fill the memory. About 1.4 bytes a cell.
  std::uint64_t max_cells = std::uint64_t{1} << 30U;
};

/// A map read from an octree. Its states are those of the octree, cell by cell: a pruned leaf becomes the finest
/// cells it stands for. Its log-odds are clamped and rounded to `map.log_odds_step()`, but never across 0. An octree
/// does not tell what a cell was before, so no cell of the map is worn (OccupancyMap::worn).
struct OctomapImport {
  /// The map that was made.
  OccupancyMap map;
  /// The largest difference between a leaf's log-odds and what the map now holds. A `.bt` holds states only; they
  /// come in at the map's clamping limits, without rounding.
  double log_odds_rounding = 0.0;
};

/// Reads a map that OctoMap saved (`.bt`, or `.ot` with an OcTree, ColorOcTree or OcTreeStamped; which of the two is
/// told by the file's first line). Throws std::runtime_error with the path and what is wrong if the file cannot be
/// read, is damaged, cut short or longer than its own count of nodes, or is too large for `max_cells`;
/// std::invalid_argument for options at fault.
[[nodiscard]] OctomapImport load_octomap(const std::filesystem::path& path, const OctomapImportOptions& options = {});

/// Writes a map for OctoMap: `.bt` keeps the states alone, `.ot` the log-odds too. Throws std::invalid_argument for
/// any other extension and for a map that reaches further than an OctoMap can (see `to_octree`), std::runtime_error
/// with the path if the file cannot be written.
void save_octomap(const OccupancyMap& map, const std::filesystem::path& path);

/// The map as an octree, pruned, with the same beam model; include <octomap/OcTree.h> to use it. Throws
/// std::invalid_argument naming the first cell outside OctoMap's [-32768, 32767] cells on each axis.
[[nodiscard]] std::unique_ptr<octomap::OcTree> to_octree(const OccupancyMap& map);

/// An octree as a map. What its own threshold calls occupied is occupied. Throws std::runtime_error if it is too
/// large for `max_cells` or holds log-odds that are not numbers.
[[nodiscard]] OctomapImport from_octree(const octomap::OcTree& tree, const OctomapImportOptions& options = {});

/// Keeps an OccupancyMap in step with the octree that a host maps into, so that the host need not map twice:
///
///     OctomapFollower follower(tree);
///     loop { tree.insertPointCloud(...); follower.update(); planner->plan(follower.map(), pose); }
///
/// It rests on OctoMap's change detection, which it switches on and whose list of changed keys it empties: the host
/// must leave that list alone. OctoMap lists cells that became known and cells whose state changed, so states follow
/// exactly; the log-odds of a cell are those at its last change of state. OctoMap lists neither deleted nodes nor
/// what was done to a node above the finest level; after such surgery, or after reading another file into the tree,
/// call `resync`.
class OctomapFollower {
 public:
  /// Takes over all that `tree` holds. The tree must outlive the follower. Errors as `from_octree`.
  explicit OctomapFollower(octomap::OcTree& tree, const OctomapImportOptions& options = {});

  /// The map that was made.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  /// Brings the map up to the tree; costs what changed. Returns how many cells changed their state. A tree that has
  /// been cleared is resynchronised. Throws std::runtime_error if the resolution of the tree has changed.
  std::size_t update();
  /// Compares everything, and writes what differs, log-odds included. Returns how many cells changed their state.
  std::size_t resync();

 private:
  void check_resolution() const;

  octomap::OcTree& tree_;
  OctomapImportOptions options_;
  OccupancyMap map_;
};

}  // namespace vantage
