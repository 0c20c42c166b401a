// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vantage/compiler.hpp>
#include <vector>

namespace vantage::detail {

/// What it costs to come from a view to another; from the number of views: from the start.
using LegCost = std::function<double(std::size_t from, std::size_t to)>;

/// One view of each layer, so that the tour through them from `start` costs least (dynamic programming). With `end`,
/// the leg from the last one to `end` counts too. At least one layer, and none is empty.
[[nodiscard]] std::vector<std::size_t> cheapest_through(const std::vector<std::vector<std::size_t>>& layers,
                                                        std::size_t start, const LegCost& leg,
                                                        std::optional<std::size_t> end = std::nullopt);

/// Views, of which some are to be taken on an open tour from a start, so that together they see what all of them see.
struct CoverTourProblem {
  std::vector<std::vector<std::uint32_t>> sees;  ///< by view: numbers of things, ascending
  double per_view = 0.0;                         ///< what a view costs besides the path to it, > 0
  LegCost leg;

  /// The number of views.
  [[nodiscard]] std::size_t size() const { return sees.size(); }
};

/// Chooses views and an order of them at once: always the view that shows most new things for what it adds to the
/// tour, at the place in the order where it adds least. Ends when nothing new can be seen, or after `most_views`. A
/// view whose things the others show is left out at the end.
[[nodiscard]] std::vector<std::size_t> cover_tour(const CoverTourProblem& problem, std::size_t most_views);

/// The tour with its first `layers` views replaced, each by one that shows nearly as much, and nearly all of
/// what no other of the tour shows, so that the tour costs least (dynamic programming over the layers).
///
///               +-- 1' --+   +-- 2' --+
///     start ----+-- 1  --+---+-- 2  --+--- 3 --- 4
///               +-- 1" --+   +-- 2" --+
[[nodiscard]] std::vector<std::size_t> refined_tour(const CoverTourProblem& problem, std::vector<std::size_t> tour,
                                                    std::size_t layers);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/cover_tour.ipp>
#endif
