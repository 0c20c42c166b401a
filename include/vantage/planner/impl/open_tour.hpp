// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vector>

namespace vantage::detail {

/// An open tour from a start over n sites, at least one, none twice. It costs
///
///     sum over positions k of   leg_weight[k] * leg(site before, site at k) + price_weight[k] * price(site at k)
///
/// With weights of 1 and 0 this is the length of the tour.
struct OpenTourProblem {
  /// The legs, as rows of n numbers: row i leads from site i to each site, row n from the start.
  std::vector<double> legs;
  std::vector<double> prices;         ///< by site
  std::vector<double> leg_weights;    ///< by position in the tour
  std::vector<double> price_weights;  ///< by position in the tour

  /// The number of sites.
  [[nodiscard]] std::size_t size() const { return prices.size(); }
  /// What it costs to have `site` at `position` after `before`, which is `size()` for the start.
  [[nodiscard]] double step(std::size_t before, std::size_t site, std::size_t position) const {
    return leg_weights[position] * legs[before * size() + site] + price_weights[position] * prices[site];
  }
  /// The cost of a tour.
  [[nodiscard]] double cost(const std::vector<std::size_t>& tour) const;
};

/// The largest number of sites for which `open_tour` is the optimum.
inline constexpr std::size_t kExactSites = 10;

/// A cheap tour over all sites: the optimum up to kExactSites (Held & Karp 1962), beyond a local one under moving up
/// to three neighbours (Or 1976) and reversing (Croes 1958), from several first sites. Always the same for the same
/// problem.
[[nodiscard]] std::vector<std::size_t> open_tour(const OpenTourProblem& problem);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/open_tour.ipp>
#endif
