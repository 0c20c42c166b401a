// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>

namespace VANTAGE_EXPORT vantage {

/// Options of FrontierGainPlanner.
struct FrontierGainOptions {
  std::size_t hypotheses = 100;  ///< random poses tried per plan, >= 1
  /// Share of the hypotheses that stand where some frontier is known to be visible, in [0, 1]; the rest are anywhere
  /// in the reachable space. 0 is the paper's; it then falls back on such poses only if no random one sees a
  /// frontier.
  double aimed_share = 0.0;
  /// What a metre of straight distance costs, in frontier cells, >= 0. 0 is the paper's: gain alone decides.
  double cost_per_m = 0.0;
  FrontierSurveyOptions survey = {};  ///< how thoroughly it looks for frontiers
};

/// The frontier method of Shade & Newman 2011, III-B.1, their baseline: poses are drawn at random in the free space
/// that the platform can reach, the frontier cells that the sensor would see from each are counted by casting rays
/// through the map, and the way to the best pose is found by A*. Unlike the paper's, cells further off than the
/// sensor resolves them do not count.
class FrontierGainPlanner final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument naming the option at fault.
  explicit FrontierGainPlanner(const PlannerSetup& setup, const FrontierGainOptions& options = {});

  /// "frontier-gain".
  [[nodiscard]] std::string_view name() const override { return "frontier-gain"; }

 private:
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;

  FrontierGainOptions options_;
};

}  // namespace vantage
