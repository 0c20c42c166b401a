// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/robot/motion_model.hpp>

namespace vantage::detail {
class EstimatedMotion;
}  // namespace vantage::detail

namespace VANTAGE_EXPORT vantage {

/// The cost that a tour minimises.
enum class TourCost : std::uint8_t {
  Time,  ///< seconds, by a motion model: for each leg the longer of moving and turning
  Path,  ///< path length, metres
};

/// What the tours of TourPlanner minimise.
struct TourOptions {
  TourCost cost = TourCost::Time;     ///< the cost that a tour minimises
  FrontierSurveyOptions survey = {};  ///< how frontiers are surveyed
};

/// Plans an open tour over views that together see the parts of the frontier known to be left, and takes its first
/// view.
///
///     u u u         S  sensor             o  views of the parts, several each; 1, 2, 3 are those of the tour
///     f f f o       f  frontier cells     u  unknown cells
///     3   2 - - 1
///     o   o     |
///          o    S
///
/// 1. Views of the nearest 24 parts, at most 1.5 m long and wide and as high as one view shows: from places around
///    the first of them, at the others, and from the current place, towards the middles of the parts. Rays find which
///    unknown cells each view sees, for a sample of at most about 500 cells.
/// 2. Choice and order at once: always the view that shows most new cells for what it adds to the tour.
/// 3. Order: the order of the chosen views that minimises the average of the cost of the whole tour and the mean cost
///    until a cell is seen. So a view that shows little comes late, unless it lies on the path.
/// 4. The first views of the tour are replaced by others that show nearly the same, so that the tour costs least.
///
/// A sensor that sees all around needs no aim: for it 1, 2 and 4 are left out, and the tour leads over one place for
/// each part, the nearest that sees a cell of it. It sees much in passing, so the legs behind the first count half.
///
/// With TourCost::Time, a leg takes the longer of moving and turning. With a motion model in the setup, the
/// planner assumes that the robot follows the path of the last plan, and the first leg starts from this motion. So
/// a robot turns back only if that saves time.
///
/// With a motion model in the setup, the sensor also looks aside at parts of the frontier on the path to the first
/// view, where there is time to turn there and on. The robot is to pass these poses without a stop.
///
/// Half of the cells that the first view sees are its goal: those first that no later view of the tour sees, and that
/// are in the middle of the image. Once they are known, the tour is planned again, so a moving robot need not stop.
///
/// Path lengths are computed on blocks of cells, so they are off by some per cent, but lead through no wall. The
/// blocks are kept from plan to plan, except where the reachable space has changed. The idea of views for each part
/// and a tour over them is that of Zhou et al. 2021 (FUEL).
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
  [[nodiscard]] Choice choose(const Situation& situation) override;

  TourOptions options_;
  std::shared_ptr<detail::EstimatedMotion> motion_;  // shared, because the type is incomplete here
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/tour_planner.ipp>
#endif
