// SPDX-License-Identifier: MIT
#include "evaluation/rh_nbv.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace vantage::detail {
namespace {

constexpr double kLambdaPerM = 0.5;
constexpr double kEdgeM = 1.0;
// A tree has so many nodes; as long as none of them has a gain, it grows up to the second number.
constexpr std::size_t kNodes = 40;
constexpr std::size_t kMostNodes = 200;
constexpr std::size_t kMostDraws = 1000;
// A node of the last branch that is nearer was reached.
constexpr double kReachedM = 0.3;
// After so many plans from one place no tree is grown: random goals would not show that the robot does not move.
constexpr std::size_t kMostStill = 3;

std::size_t nearest_node(const std::vector<TreeNode>& tree, const Eigen::Vector3d& to) {
  const auto nearest = std::min_element(tree.begin(), tree.end(), [&](const TreeNode& a, const TreeNode& b) {
    return (a.pose.translation() - to).squaredNorm() < (b.pose.translation() - to).squaredNorm();
  });
  return static_cast<std::size_t>(nearest - tree.begin());
}

}  // namespace

std::vector<double> branch_values(const std::vector<TreeNode>& tree, double lambda_per_m) {
  std::vector<double> values(tree.size(), 0.0);
  for (std::size_t i = 1; i < tree.size(); ++i) {
    values[i] = values[tree[i].parent] + tree[i].gain * std::exp(-lambda_per_m * tree[i].way_m);
  }
  return values;
}

TreeNode RhNbvPeer::viewed(const Situation& situation, const VoxelIndex& place, const UnknownVolume& volume,
                           Dice& dice, std::uint64_t& operations) {
  const Eigen::Vector3d position = situation.reachable().position_in(place);
  const std::size_t yaw = dice.below(UnknownVolume::kColumns);
  TreeNode node{.pose = situation.platform().facing(position, UnknownVolume::direction(yaw))};
  node.gain = volume.in_view(volume.columns(position, operations), yaw);
  return node;
}

// What is left of the last branch.
void RhNbvPeer::seed(const Situation& situation, std::vector<TreeNode>& tree, const UnknownVolume& volume,
                     std::uint64_t& operations) const {
  const OccupancyMap& map = situation.map();
  for (const Pose& pose : branch_before_) {
    const double edge_m = (pose.translation() - tree.back().pose.translation()).norm();
    if (tree.size() == 1 && edge_m < kReachedM) {
      continue;
    }
    if (!situation.reachable().contains(map.frame().cell_of(pose.translation())) ||
        !situation.platform().admits_motion(map, tree.back().pose, pose)) {
      break;
    }
    const Eigen::Vector3d axis = optical_axis(pose);
    const double yaw = std::atan2(axis.y(), axis.x()) / (2.0 * std::numbers::pi) * UnknownVolume::kColumns;
    const auto column =
        static_cast<std::size_t>(std::lround(yaw + UnknownVolume::kColumns)) % UnknownVolume::kColumns;
    const double gain = volume.in_view(volume.columns(pose.translation(), operations), column);
    tree.push_back({pose, tree.size() - 1, tree.back().way_m + edge_m, gain});
  }
}

std::vector<TreeNode> RhNbvPeer::tree(const Situation& situation, const UnknownVolume& volume,
                                      PlanStatistics& statistics) {
  const OccupancyMap& map = situation.map();
  const ReachableSpace& reachable = situation.reachable();
  Dice dice(situation.setup().seed, map.revision());
  std::vector<TreeNode> tree{{.pose = situation.current()}};
  seed(situation, tree, volume, statistics.ray_operations);
  double most_gain = 0.0;
  for (std::size_t draw = 0; draw < kMostDraws && tree.size() < (most_gain > 0.0 ? kNodes : kMostNodes); ++draw) {
    const Eigen::Vector3d towards = map.frame().centre_of(reachable.cell(dice.below(reachable.size())));
    const std::size_t parent = nearest_node(tree, towards);
    const Eigen::Vector3d from = tree[parent].pose.translation();
    const double line_m = (towards - from).norm();
    const VoxelIndex place = node_cell(
        map.frame(), map.frame().cell_of(from + std::min(1.0, kEdgeM / std::max(line_m, 1e-9)) * (towards - from)));
    if (!reachable.contains(place)) {
      continue;
    }
    TreeNode node = viewed(situation, place, volume, dice, statistics.ray_operations);
    const double edge_m = (node.pose.translation() - from).norm();
    if (edge_m < map.resolution_m() || !situation.platform().admits_motion(map, tree[parent].pose, node.pose)) {
      continue;
    }
    node.parent = parent;
    node.way_m = tree[parent].way_m + edge_m;
    most_gain = std::max(most_gain, node.gain);
    tree.push_back(node);
  }
  statistics.views_scored += tree.size() - 1;
  return tree;
}

// The first edge of the branch to `end`.
Choice RhNbvPeer::first_edge(const Situation& situation, const std::vector<TreeNode>& tree, std::size_t end,
                             const PlanStatistics& so_far) {
  branch_.clear();
  for (std::size_t node = end; node != 0; node = tree[node].parent) {
    branch_.insert(branch_.begin(), tree[node].pose);
  }
  const Pose& first = branch_.front();
  Choice choice{.path = {situation.current(), first}, .statistics = so_far};
  TargetView view = targets_seen_from(situation.surveyed(), first, choice.statistics.ray_operations);
  view.hoped = std::exchange(view.unknown, {});
  if (branch_.size() == 1) {  // it goes there to see them
    std::swap(view.hoped, view.unknown);
  }
  choice.view = std::move(view);
  choice.reason = "the first of " + std::to_string(branch_.size()) + " edges of the best branch";
  return choice;
}

Choice RhNbvPeer::choose(const Situation& situation) {
  if (situation.map().revision() != planned_) {  // a second plan for the same map starts from the same branch
    branch_before_ = std::move(branch_);
    planned_ = situation.map().revision();
    const Eigen::Vector3d here = situation.current().translation();
    still_ = (here - planned_at_m_).norm() < 0.5 * situation.map().resolution_m() ? still_ + 1 : 0;
    planned_at_m_ = here;
  }
  branch_.clear();
  const UnknownVolume volume(situation.map(), situation.sensor());
  begin_tree(situation.map(), volume);
  PlanStatistics statistics;
  if (!situation.reachable().only_turns() && still_ < kMostStill) {
    const std::vector<TreeNode> grown = tree(situation, volume, statistics);
    const std::vector<double> values = branch_values(grown, kLambdaPerM);
    std::vector<std::size_t> order(grown.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
    // Unknown space that is given up, or that no view can show, is no gain: the last view must see a target.
    for (const std::size_t end : order) {
      if (end != 0 && grown[end].gain > least_share() * volume.most() &&
          !targets_seen_from(situation.surveyed(), grown[end].pose, statistics.ray_operations).unknown.empty()) {
        return first_edge(situation, grown, end, statistics);
      }
    }
  }
  return nearest_view(situation, statistics);
}

}  // namespace vantage::detail
