// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>

namespace VANTAGE_EXPORT vantage {

/// Number and cost of the random poses of FrontierGainPlanner.
struct FrontierGainOptions {
  std::size_t hypotheses = 100;  ///< random poses evaluated per plan, in [1, 1e6]
  /// Views are ranked by frontier cells / (1 + cost_per_m * straight distance in metres), >= 0. With the paper's 0,
  /// the gain alone decides.
  double cost_per_m = 0.0;
  FrontierSurveyOptions survey = {};  ///< how frontiers are surveyed
};

/// Baseline planner: draws poses in the reachable space at random, counts by ray casting the frontier cells that the
/// sensor would see from each, and takes the best. If none of them sees a frontier, poses at the viewpoints of random
/// targets are tried. The path is found by A*. Unlike in the paper, cells beyond the resolving range of the sensor do
/// not count, and the goal to which the robot is moving is a candidate, too: a robot that plans while it moves would
/// turn around at every other draw. (Shade & Newman 2011, III-B.1.)
class FrontierGainPlanner final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  explicit FrontierGainPlanner(const PlannerSetup& setup, const FrontierGainOptions& options = {});

  [[nodiscard]] std::string_view name() const override { return "frontier-gain"; }

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override;

  FrontierGainOptions options_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/frontier_gain_planner.ipp>
#endif
