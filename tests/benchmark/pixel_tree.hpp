// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/raytrace/ray_tree.hpp>
#include <vector>

namespace vantage {

/// The pixels of a camera as a tree of rays: each 2 x 2 rays of a level have one parent in the level above.
class PixelTree {
 public:
  /// The last level has all pixels; the first must have a whole number of columns and rows.
  PixelTree(const RangeSensor& camera, int levels);

  /// See RayTree.
  [[nodiscard]] const RayImage& rays(int level) const { return at(level).image; }
  /// See RayTree.
  [[nodiscard]] std::span<const std::uint32_t> children(int level, std::uint32_t ray) const {
    return at(level).children.empty() ? std::span<const std::uint32_t>() : at(level).children[ray];
  }
  /// See RayTree.
  [[nodiscard]] std::uint32_t leaves(int level, std::uint32_t /*ray*/) const { return at(level).leaves; }

 private:
  struct Level {
    RayImage image;
    std::vector<std::array<std::uint32_t, 4>> children;
    std::uint32_t leaves = 0;
  };

  [[nodiscard]] const Level& at(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  std::vector<Level> levels_;
};

}  // namespace vantage
