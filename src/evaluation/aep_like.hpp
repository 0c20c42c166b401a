// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/map/known_map.hpp>
#include <vector>

#include "evaluation/rh_nbv.hpp"

namespace vantage::detail {

/// UnknownVolume::columns of places, kept until something changes within range of them.
class KeptColumns {
 public:
  /// Forgets what may have changed in the map since the last call.
  void follow(const OccupancyMap& map, double range_m);
  /// The columns from the centre of a cell, which `compute` makes if they are not kept.
  template <class Compute>
  [[nodiscard]] const std::vector<double>& at(const VoxelIndex& place, Compute&& compute) {
    auto kept = columns_.find(place);
    if (kept == columns_.end()) {
      kept = columns_.emplace(place, compute()).first;
    }
    return kept->second;
  }
  /// The number of places.
  [[nodiscard]] std::size_t size() const { return columns_.size(); }

 private:
  KnownMap map_;
  OccupancyMap::Revision revision_ = 0;
  std::map<VoxelIndex, std::vector<double>, RasterOrder> columns_;
};

/// `aep-like`, see make_exploration_peer.
class AepLikePeer final : public RhNbvPeer {
 public:
  using RhNbvPeer::RhNbvPeer;

 private:
  [[nodiscard]] TreeNode viewed(const Situation& situation, const VoxelIndex& place, const UnknownVolume& volume,
                                Dice& dice, std::uint64_t& operations) override;
  [[nodiscard]] double least_share() const override { return 0.05; }
  [[nodiscard]] VoxelIndex node_cell(const VoxelFrame& frame, const VoxelIndex& cell) const override;
  void begin_tree(const OccupancyMap& map, const UnknownVolume& volume) override {
    kept_.follow(map, volume.range_m());
  }

  KeptColumns kept_;
};

}  // namespace vantage::detail
