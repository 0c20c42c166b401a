// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>

namespace VANTAGE_EXPORT vantage {

/// Options of NextBestViewExplorer.
struct NextBestViewExplorerOptions {
  std::size_t hypotheses = 100;       ///< views weighed per plan, >= 1
  FrontierSurveyOptions survey = {};  ///< how thoroughly it looks for frontiers
};

/// Next best views without an object: of views drawn at random, half of them aimed at frontiers, the one that sees
/// most unknown cells for its distance (Vasquez-Gomez et al. 2013, eq. 2 and 6, over the whole map).
class NextBestViewExplorer final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument naming the option or the part of the setup at fault.
  explicit NextBestViewExplorer(const PlannerSetup& setup, const NextBestViewExplorerOptions& options = {});

  /// "next-best-view".
  [[nodiscard]] std::string_view name() const override { return "next-best-view"; }

 private:
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;

  NextBestViewExplorerOptions options_;
};

}  // namespace vantage
