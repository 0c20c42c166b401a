// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// OctoMap's octrees: 16 levels below the root, finest cells -32768 .. 32767 on each axis.
inline constexpr int kOctomapDepth = 16;
inline constexpr std::int32_t kOctomapReach = 1 << 15;

/// A leaf: the cube of 2^level finest cells an edge from `first`. Infinite log-odds: the state alone is known.
struct OctomapLeaf {
  VoxelIndex first;
  int level = 0;
  double log_odds = 0.0;
  bool occupied = false;

  [[nodiscard]] std::uint64_t cells() const { return std::uint64_t{1} << (3 * level); }
};

/// A `.bt` or `.ot` file in memory, read and checked without OctoMap: its own reader follows a damaged file wherever
/// it leads, and prints.
class OctomapFile {
 public:
  /// Throws std::runtime_error with the path if the file cannot be read or its header is not OctoMap's.
  explicit OctomapFile(const std::filesystem::path& path);

  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  /// Calls `visit` for every leaf. Throws std::runtime_error with the path where the data are damaged.
  void for_each_leaf(const std::function<void(const OctomapLeaf&)>& visit) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  class Reader;

  void read_header();

  std::filesystem::path path_;
  std::string bytes_;
  std::size_t data_ = 0;           // where the nodes begin
  bool states_only_ = false;       // .bt
  std::size_t payload_bytes_ = 0;  // per node of an .ot, between the log-odds and the children
  std::uint64_t nodes_ = 0;
  double resolution_m_ = 0.0;
};

}  // namespace vantage::detail
