// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/field/harmonic_field.hpp>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The points in which HarmonicPlanner extends the paper or differs from it.
struct HarmonicStrategy {
  /// A sink whose path is longer than that to the nearest sink by more than this waits for a later plan, metres, >=
  /// 0. So nearby frontiers are finished first, and the field covers only the cells that are nearer than its sinks.
  /// Infinity: all frontiers are sinks, and the field covers the reachable space.
  double detour_m = 0.2;
  /// True: looks from the first cell of the path that sees the target frontier or, after half a metre, any other one
  /// (see the function look_early). False: looks from its end.
  bool look_early = true;
  /// For a sensor that does not see all around: before it moves on, it looks from its current place in the
  /// direction of highest expected gain, as long as that gain is at least this volume of unknown space, m^3, >= 0.
  /// At its goal it also takes the direction of highest gain. Infinity: one look per place, in the direction that
  /// sees most targets. Ignored for a map of one layer of cells.
  double look_again_m3 = 0.1;
  /// True: takes the shortest path to the place of the view, not the streamline.
  bool shortest_way = true;
  /// The plain method of the paper.
  [[nodiscard]] static HarmonicStrategy faithful() {
    return {.detour_m = std::numeric_limits<double>::infinity(),
            .look_early = false,
            .look_again_m3 = std::numeric_limits<double>::infinity(),
            .shortest_way = false};
  }
};

/// All options of HarmonicPlanner. Settings (make_planner) set most of them by name.
struct HarmonicOptions {
  HarmonicFieldOptions field = {};    ///< how the field is solved
  HarmonicStrategy strategy = {};     ///< refinements of the method
  FrontierSurveyOptions survey = {};  ///< how frontiers are surveyed
};

/// Harmonic exploration: solves Laplace's equation over the reachable space, with 1 at the sensor, 0 at the frontiers
/// and no flow through the rest of the boundary, and follows the steepest descent.
///
///     ###########################      phi = 1 at S (sensor), 0 at o (sink)
///     #  S . .                  o      #  no flow
///     #        . . . . . . . .  o      .  streamline: follows -grad phi to one sink
///     ###########################
///
/// The sensor of the paper is a point. Here the domain lies in the reachable space of the platform, and a frontier
/// cell is represented by the reachable cell from which its unknown neighbour is observed (FrontierSurvey). A
/// streamline is used only if it is known to end at a sink. docs/harmonic.md lists where each equation is
/// implemented. (Shade & Newman 2011.)
class HarmonicPlanner final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  explicit HarmonicPlanner(const PlannerSetup& setup, const HarmonicOptions& options = {});

  [[nodiscard]] std::string_view name() const override { return "harmonic"; }

  /// The field of the last plan, for display. If it does not lead to a sink (HarmonicField::followed), the plan takes
  /// the shortest path. None if the plan needed none: nothing was left, the sensor looks from where it is,
  /// or there was only one sink and the shortest path is taken.
  [[nodiscard]] const std::optional<HarmonicField>& field() const { return field_; }

 private:
  PlanStatistics prepare(const Situation& situation) override;
  [[nodiscard]] Choice choose(const Situation& situation) override;
  [[nodiscard]] std::vector<VoxelIndex> way_down(const Situation& situation, const NearGoals& near,
                                                 PlanStatistics& statistics);
  [[nodiscard]] NearGoals sinks(const Situation& situation) const;

  HarmonicOptions options_;
  std::optional<HarmonicField> field_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/harmonic_planner.ipp>
#endif
