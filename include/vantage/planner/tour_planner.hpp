// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/robot/motion_model.hpp>

namespace VANTAGE_EXPORT vantage {

/// What a tour is to save.
enum class TourCost : std::uint8_t {
  Time,  ///< seconds by the motion model of the setup: the longer of moving and turning
  Path,  ///< metres
};

/// Options of TourPlanner.
struct TourOptions {
  TourCost cost = TourCost::Time;  ///< what a tour is to save
  /// Largest extent along an axis of a part of the frontier that one view is to cover, metres, > 0. Larger clusters
  /// of frontier cells are divided.
  double site_m = 1.5;
  std::size_t most_sites = 24;        ///< number of nearest parts over which a tour leads, in [1, 200]
  FrontierSurveyOptions survey = {};  ///< how frontiers are surveyed
};

/// Plans an open tour over the parts of the frontier known to be left, and takes its first view.
///
///     o - - - 3          S  sensor            1, 2, 3  the tour, from S, nowhere back
///     |       |          u  unknown cells
///     2 - 1 - S  u u u   price of 1: the mean way to it from all unknown cells, through free and unknown space
///
/// Of all orders it takes the one with the least cost of the whole tour less the price of its first part. The price
/// is what it would cost to come back to a part that is left behind, since the robot will later be where the unknown
/// is. So what is far from the rest is done while the robot is near. The view is taken from the place
/// nearest to the robot that sees a cell of the part, and the tour planned again once that cell is known.
///
/// Lengths of ways are computed on blocks of cells, so they are off by some per cent, but lead through no wall. The
/// idea of the price is that of Ericson et al. 2025 ("distance advantage"), with unknown cells in place of known
/// ones.
class TourPlanner final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  explicit TourPlanner(const PlannerSetup& setup, const TourOptions& options = {});

  [[nodiscard]] std::string_view name() const override { return "tour"; }
  /// The options of the constructor.
  [[nodiscard]] const TourOptions& options() const { return options_; }
  /// The motion model that is used if the setup has none: 2 m/s, 3 m/s^2, 90 degrees per second.
  [[nodiscard]] static MotionModel default_motion();

 private:
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;

  TourOptions options_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/tour_planner.ipp>
#endif
