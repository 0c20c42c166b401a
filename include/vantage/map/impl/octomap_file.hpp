// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// Layout of OctoMap's octrees: 16 levels below the root; finest cells -32768 .. 32767 on each axis.
inline constexpr int kOctomapDepth = 16;
inline constexpr std::int32_t kOctomapReach = 1 << 15;

/// A leaf: a cube with an edge of 2^level finest cells, starting at `first`. Infinite log-odds mean that only the
/// state is known.
struct OctomapLeaf {
  VoxelIndex first;
  int level = 0;
  double log_odds = 0.0;
  bool occupied = false;

  [[nodiscard]] std::uint64_t cells() const { return std::uint64_t{1} << (3 * level); }
};

/// A `.bt` or `.ot` file in memory, parsed and checked without OctoMap. OctoMap's own reader does not detect damaged
/// files, and prints.
class OctomapFile {
 public:
  /// Throws std::runtime_error, with the path, if the file cannot be read or has no valid OctoMap header.
  explicit OctomapFile(const std::filesystem::path& path);

  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  /// Calls `visit` for every leaf. Throws std::runtime_error, with the path, if the data are damaged.
  void for_each_leaf(const std::function<void(const OctomapLeaf&)>& visit) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  class Reader;

  void read_header();

  std::filesystem::path path_;
  std::string bytes_;
  std::size_t data_ = 0;           // offset of the first node
  bool states_only_ = false;       // a .bt file
  std::size_t payload_bytes_ = 0;  // bytes per node of an .ot file between the log-odds and the children
  std::uint64_t nodes_ = 0;
  double resolution_m_ = 0.0;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/octomap_file.ipp>
#endif
