// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/map/map_follower.hpp>

namespace octomap {
class OcTree;
}

namespace VANTAGE_EXPORT vantage {

/// How an octree is converted to an OccupancyMap.
struct OctomapImportOptions {
  /// Options of the new map. `resolution_m` is ignored: the octree sets it. An `.ot` file does not store its beam
  /// model, so give the constants of its producer here, or free cells may appear contested (OccupancyMap::contested).
  /// An octree in memory knows its beam model. If that differs from these options, the log-odds of free cells are
  /// rounded to the nearest whole number of misses.
  OccupancyMapOptions map = {};
  /// Largest number of finest cells that the leaves may expand to. It protects against a damaged file, where a single
  /// leaf near the root would fill the memory. One cell needs about 1.4 bytes.
  std::uint64_t max_cells = std::uint64_t{1} << 30U;
};

/// The result of an import. Each state equals that of the octree; a pruned leaf is expanded to its finest cells. The
/// log-odds are clamped and rounded to `map.log_odds_step()`, but never across 0.
struct OctomapImport {
  /// The imported map.
  OccupancyMap map;
  /// The largest difference between the log-odds of a leaf and those of the map. A `.bt` file holds states only: they
  /// get log-odds at the clamping limits, and the difference is 0.
  double log_odds_rounding = 0.0;
};

/// Loads a `.bt` file, or an `.ot` file with an OcTree, ColorOcTree or OcTreeStamped. The first line of the file
/// decides the format. Throws std::runtime_error, with the path, if the file cannot be read, is damaged, truncated or
/// longer than its node count, or exceeds `max_cells`. Throws std::invalid_argument for invalid options.
[[nodiscard]] OctomapImport load_octomap(const std::filesystem::path& path, const OctomapImportOptions& options = {});

/// Saves a map for OctoMap: `.bt` stores states only, `.ot` also log-odds. Throws std::invalid_argument for another
/// extension or if the map exceeds the range of OctoMap (see `to_octree`), and std::runtime_error, with the path, if
/// the file cannot be written.
void save_octomap(const OccupancyMap& map, const std::filesystem::path& path);

/// Converts a map to a pruned octree with the same beam model. Include <octomap/OcTree.h> to use the result. Throws
/// std::invalid_argument, which names the first cell outside OctoMap's range of [-32768, 32767] cells per axis.
[[nodiscard]] std::unique_ptr<octomap::OcTree> to_octree(const OccupancyMap& map);

/// Converts an octree to a map. A cell is occupied if the threshold of the octree says so. Throws std::runtime_error
/// if the octree exceeds `max_cells` or holds NaN log-odds, std::invalid_argument for invalid options.
[[nodiscard]] OctomapImport from_octree(const octomap::OcTree& tree, const OctomapImportOptions& options = {});

/// Keeps an OccupancyMap synchronised with an octree that the host maintains, so that the host does not map twice:
///
///     OctomapFollower follower(tree);
///     loop { tree.insertPointCloud(...); follower.update(); planner->plan(follower.map(), pose); }
///
/// It uses OctoMap's change detection: it enables it and clears the list of changed keys, so the host must not use
/// that list. The list holds cells that became known or changed their state. States are therefore always exact, but
/// the log-odds of a cell are those of its last change of state. OctoMap does not list deleted nodes or changes of
/// inner nodes. Call `resync` after such edits, or after another file was read into the tree.
class OctomapFollower {
 public:
  /// Imports the whole `tree`. The tree must outlive the follower. Errors as `from_octree`.
  explicit OctomapFollower(octomap::OcTree& tree, const OctomapImportOptions& options = {});

  /// The synchronised map.
  [[nodiscard]] const OccupancyMap& map() const { return follower_.map(); }
  /// Applies the changes of the tree since the last call. The cost depends on the number of changes. One call is one
  /// revision of the map, also if nothing has changed: call it once after each scan (see MapFollower::update). An
  /// empty tree triggers a `resync`. Returns the number of cells that changed their state. Throws std::runtime_error
  /// if the resolution of the tree has changed.
  std::size_t update();
  /// Compares all cells and corrects the differences, log-odds included. Returns the number of cells that changed
  /// their state. Errors as `update` and `from_octree`.
  std::size_t resync();

 private:
  void check_resolution() const;

  octomap::OcTree& tree_;
  OctomapImportOptions options_;
  MapFollower follower_;
};

}  // namespace vantage

// Without OctoMap nothing of this can be called.
#if defined(VANTAGE_HEADER_ONLY) && __has_include(<octomap/OcTree.h>)
#include <vantage/map/impl/octomap_bridge.ipp>
#endif
