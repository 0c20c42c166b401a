// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/view/frontier_survey.hpp>
#include <vector>

namespace vantage::detail {

/// A part of the frontier that one view is to cover.
struct FrontierSite {
  FrontierTarget middle;                ///< the target nearest to the centroid of the part
  std::vector<FrontierTarget> targets;  ///< all of them, in the order of the survey
};

/// Divides targets, in raster order of their frontier cells, into clusters that touch through corners, and those by
/// halving until none has more than `most` cells (at least 1) along an axis.
[[nodiscard]] std::vector<FrontierSite> frontier_sites(const std::vector<FrontierTarget>& targets,
                                                       const VoxelIndex& most);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/frontier_sites.ipp>
#endif
