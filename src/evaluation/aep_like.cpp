// SPDX-License-Identifier: MIT
#include "evaluation/aep_like.hpp"

#include <algorithm>
#include <vantage/map/brick.hpp>

#include <vantage/geometry/impl/box_around.hpp>

namespace vantage::detail {
namespace {

// Nodes stand on a lattice, so that gains that are kept can be used.
constexpr double kNodeLatticeM = 0.5;

std::int32_t on_lattice(std::int32_t at, std::int32_t step) { return at - (at % step + step) % step + step / 2; }

}  // namespace

VoxelIndex AepLikePeer::node_cell(const VoxelFrame& frame, const VoxelIndex& cell) const {
  const std::int32_t step = std::max(1, frame.cells_up_to(kNodeLatticeM));
  return {on_lattice(cell.x, step), on_lattice(cell.y, step), cell.z};
}

void KeptColumns::follow(const OccupancyMap& map, double range_m) {
  if (!map_.is(map)) {
    columns_.clear();
  } else if (const std::vector<VoxelIndex> bricks = map.changed_since(revision_); !bricks.empty()) {
    const VoxelBox touched = Brick::cells_of(box_around(bricks)).grown(map.frame().cells_up_to(range_m) + 1);
    std::erase_if(columns_, [&](const auto& kept) { return touched.contains(kept.first); });
  }
  map_ = KnownMap(map);
  revision_ = map.revision();
}

TreeNode AepLikePeer::viewed(const Situation& situation, const VoxelIndex& place, const UnknownVolume& volume,
                             Dice& /*dice*/, std::uint64_t& operations) {
  const Eigen::Vector3d position = situation.reachable().position_in(place);
  const std::vector<double>& columns = kept_.at(place, [&] { return volume.columns(position, operations); });
  std::size_t best = 0;
  TreeNode node;
  for (std::size_t yaw = 0; yaw < UnknownVolume::kColumns; ++yaw) {
    if (const double gain = volume.in_view(columns, yaw); gain > node.gain) {
      node.gain = gain;
      best = yaw;
    }
  }
  node.pose = situation.platform().facing(position, UnknownVolume::direction(best));
  return node;
}

}  // namespace vantage::detail
