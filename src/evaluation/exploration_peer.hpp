// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vantage/planner/frontier_planner.hpp>
#include <vector>

#include <vantage/planner/impl/tour_legs.hpp>
#include <vantage/planner/impl/tour_views.hpp>
#include <vantage/robot/impl/block_ways.hpp>
#include <vantage/robot/impl/estimated_motion.hpp>
#include <vantage/view/impl/frontier_sites.hpp>

namespace vantage::detail {

/// A part of the frontier and views of it, the one that shows most of it first; at least one.
struct ViewedSite {
  FrontierSite site;
  double way_m = 0.0;               ///< from the start to the viewpoint of its middle
  std::vector<VoxelIndex> unknown;  ///< cells that stand for those of the part
  std::vector<TourView> views;      ///< `sees` are numbers in `unknown`
};

/// What the exploration peers share.
class ExplorationPeer : public FrontierPlanner {
 public:
  /// `name` must outlive the object.
  ExplorationPeer(std::string_view name, const PlannerSetup& setup) : FrontierPlanner(setup), name_(name) {}

  [[nodiscard]] std::string_view name() const final { return name_; }

 protected:
  /// Largest length and width of a part of the frontier, metres.
  static constexpr double kSiteM = 2.0;

  /// The parts of the frontier, the nearest by way first, without views.
  [[nodiscard]] std::vector<ViewedSite> sites(const Situation& situation,
                                              const std::vector<double>& from_start) const;
  /// Samples views of a part and keeps those that show nearly as much as the best, at most `most`.
  void sample_views(const Situation& situation, ViewedSite& site, std::size_t most, PlanStatistics& statistics) const;
  /// Costs of tours over views, in seconds; the references must outlive it.
  [[nodiscard]] TourLegs legs(const Situation& situation, const std::vector<double>& from_start,
                              const std::vector<TourView>& views) const {
    const Eigen::Vector3d velocity_m_s = motion_.velocity_at(situation.current().translation());
    return {situation, TourCost::Time, velocity_m_s, situation.ways(), from_start, views};
  }
  /// Takes this view, until half of the cells that it sees are known, those in the middle of the image first.
  /// Its statistics begin with `so_far`.
  [[nodiscard]] Choice taking(const Situation& situation, const TourView& view,
                              const std::vector<VoxelIndex>& unknown, const PlanStatistics& so_far);

 private:
  std::string_view name_;
  EstimatedMotion motion_;
};

}  // namespace vantage::detail
