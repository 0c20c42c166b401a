// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vantage/geometry/pose.hpp>
#include <vector>

#include <vantage/geometry/impl/dice.hpp>
#include "evaluation/exploration_peer.hpp"
#include "evaluation/unknown_volume.hpp"

namespace vantage::detail {

/// A view in a tree.
struct TreeNode {
  Pose pose;               ///< world_from_sensor
  std::size_t parent = 0;  ///< number of a node before this one; 0 for the root
  double way_m = 0.0;      ///< from the root
  double gain = 0.0;       ///< of this view alone
};

/// For each node: the sum of gain * exp(-lambda * path length) over the nodes from the root to it, the root left out.
[[nodiscard]] std::vector<double> branch_values(const std::vector<TreeNode>& tree, double lambda_per_m);

/// `rh-nbv`, see make_exploration_peer.
class RhNbvPeer : public ExplorationPeer {
 public:
  using ExplorationPeer::ExplorationPeer;

 protected:
  /// The view at a place, its gain included: a random yaw.
  [[nodiscard]] virtual TreeNode viewed(const Situation& situation, const VoxelIndex& place,
                                        const UnknownVolume& volume, Dice& dice, std::uint64_t& operations);
  /// Branches whose best view shows less than this share of UnknownVolume::most are not followed.
  [[nodiscard]] virtual double least_share() const { return 0.0; }
  /// The cell of the lattice on which nodes stand that is near to this one.
  [[nodiscard]] virtual VoxelIndex node_cell(const VoxelFrame& /*frame*/, const VoxelIndex& cell) const {
    return cell;
  }
  /// Called before a tree grows.
  virtual void begin_tree(const OccupancyMap& /*map*/, const UnknownVolume& /*volume*/) {}

 private:
  [[nodiscard]] Choice choose(const Situation& situation) final;
  [[nodiscard]] std::vector<TreeNode> tree(const Situation& situation, const UnknownVolume& volume,
                                           PlanStatistics& statistics);
  void seed(const Situation& situation, std::vector<TreeNode>& tree, const UnknownVolume& volume,
            std::uint64_t& operations) const;
  [[nodiscard]] Choice first_edge(const Situation& situation, const std::vector<TreeNode>& tree, std::size_t end,
                                  const PlanStatistics& so_far);

  std::vector<Pose> branch_;         // the best one of the last plan
  std::vector<Pose> branch_before_;  // that of the plan before
  OccupancyMap::Revision planned_ = 0;
  Eigen::Vector3d planned_at_m_ = Eigen::Vector3d::Zero();
  std::size_t still_ = 0;  // plans in a row from about the same place
};

}  // namespace vantage::detail
