// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vantage/compiler.hpp>
#include <vector>

namespace vantage::detail {

/// An open tour from a start over n sites, at least one, none twice. It costs
///
///     (length of the tour + mean length until a thing is shown) / 2
///
/// where each site shows a share of the things. So a site that shows much comes early, and one that shows little
/// where it is a small detour. That is the sum over the legs of
///
///     leg * (1 + share of the things that are not shown before it) / 2
struct OpenTourProblem {
  /// The legs, as rows of n numbers: row i leads from site i to each site, row n from the start.
  std::vector<double> legs = {};
  /// By site: a share of the things, in sum 1; or 1 each: any first one shows all; or 0 each: the length alone
  /// counts.
  std::vector<double> shows = {};

  /// The number of sites.
  [[nodiscard]] std::size_t size() const { return shows.size(); }
  /// What it costs to come to `site` from `before`, which is `size()` for the start, with a share of the things not
  /// shown before.
  [[nodiscard]] double step(std::size_t before, std::size_t site, double unseen) const {
    return legs[before * size() + site] * (1.0 + unseen) / 2.0;
  }
  /// The share of the things that is not shown after `site` if it was `unseen` before.
  [[nodiscard]] double unseen_after(std::size_t site, double unseen) const {
    return std::max(0.0, unseen - shows[site]);
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
#include <vantage/view/impl/open_tour.ipp>
#endif
