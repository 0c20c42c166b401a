// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/planner/situation.hpp>
#include <vector>

#include <vantage/view/impl/frontier_sites.hpp>

namespace vantage::detail {

/// The parts of the frontier, for one view each: at most `most_m` long and wide, metres, and at most as high as that
/// or as what the sensor sees from the furthest places around a part, whichever is more.
[[nodiscard]] std::vector<FrontierSite> frontier_parts(const Situation& situation, double most_m);

/// A view that a tour may take.
struct TourView {
  VoxelIndex place;                 ///< a reachable cell
  Pose pose;                        ///< world_from_sensor
  std::vector<std::uint32_t> sees;  ///< numbers of unknown cells, ascending
};

/// Views of parts of the frontier, and what they see of them.
///
///        o   o   o         f  part of the frontier     u  its unknown cells     o  places around it
///      o   u u u   o
///      o V f f f   o       V  the viewpoint of the survey, the frontier itself, and where the robot is,
///        o   o   o         are places too. From each, the sensor looks at the middles of the parts.
///
/// Only reachable places count. The first parts, those that are looked at first, have places all around; the others
/// have only V and the frontier. If the parts have many unknown cells, some of each stand for all. So the cost of the
/// rays is bounded, whatever the size of the cells.
struct TourViews {
  std::vector<VoxelIndex> unknown;  ///< unknown cells of all parts, in raster order
  std::vector<double> shares;       ///< by unknown cell: 1 / number of those of its part, of the smallest one
  std::vector<TourView> views;      ///< each sees some of them

  /// `sites`: nearest first. Adds the number of visited cells to `operations`.
  TourViews(const Situation& situation, const std::vector<FrontierSite>& sites, std::uint64_t& operations);

  /// The views from a position (metres, world) in the cell `place`, each towards the middle of another part, without
  /// two that see the same. Adds the number of visited cells to `operations`.
  [[nodiscard]] std::vector<TourView> views_from(const VoxelIndex& place, const Eigen::Vector3d& position_m,
                                                 const Situation& situation, std::uint64_t& operations) const;

 private:
  std::vector<Eigen::Vector3d> middles_;  // of the unknown cells of each part
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/tour_views.ipp>
#endif
