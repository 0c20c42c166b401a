// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/planner/next_best_view_planner.hpp>

namespace vantage::detail {

/// Options behind the name "next-best-view".
struct NextBestViewChoices {
  NextBestViewOptions object = {};               ///< with an object
  NextBestViewExplorerOptions exploration = {};  ///< without one
};

}  // namespace vantage::detail
