// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/frontier/void_tiles.hpp>

namespace vantage {

VANTAGE_INLINE VoidTiles::VoidTiles(const OccupancyMap& map) {
  map.for_each_brick([this](const VoxelIndex& address, const Brick& /*brick*/) { add(address); });
}

VANTAGE_INLINE void VoidTiles::add(const VoxelIndex& brick) {
  const VoxelIndex tile{brick.x >> 3, brick.y >> 3, brick.z >> 3};
  const bool is_new = held_.find(tile) == nullptr;
  held_.insert(brick);
  if (!is_new) {
    return;
  }
  for_each_cell(VoxelBox{tile, tile + VoxelIndex{1, 1, 1}}.grown(1), [this](const VoxelIndex& near) {
    bool& known = near_.place(near);
    if (!known) {
      known = true;
      tiles_.push_back(near);
    }
  });
}

}  // namespace vantage
