// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/planner/frontier_planner.hpp>

namespace VANTAGE_EXPORT vantage {

/// How many views NextBestViewExplorer evaluates, and how it surveys frontiers.
struct NextBestViewExplorerOptions {
  std::size_t hypotheses = 100;       ///< views evaluated per plan, >= 1
  FrontierSurveyOptions survey = {};  ///< how frontiers are surveyed
};

/// Next-best-view planning without an object: draws views at random, every other one aimed at a target, and takes the
/// one with the highest utility among those that see a target: unknown cells seen, divided by 1 + distance. All views
/// are ranked with few rays, and the best 20 again with all. The goal to which the robot is moving is a
/// candidate, too. (Vasquez-Gomez et al. 2013, eq. 4 and 5, over the whole map.)
class NextBestViewExplorer final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  explicit NextBestViewExplorer(const PlannerSetup& setup, const NextBestViewExplorerOptions& options = {});

  [[nodiscard]] std::string_view name() const override { return "next-best-view"; }

 private:
  [[nodiscard]] Choice choose(const Situation& situation) override;

  NextBestViewExplorerOptions options_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/next_best_view_explorer.ipp>
#endif
