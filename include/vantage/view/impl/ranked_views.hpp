// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vantage/raytrace/following_caster.hpp>
#include <vector>

#include <vantage/raytrace/impl/shared_work.hpp>

namespace vantage::detail {

/// Evaluates candidate views and sorts them, the best first. If there are more than `finalists`, it evaluates all
/// with few rays, which tells most of them apart; the best of them, `finalists`, with a quarter of the rays; and the
/// `best` of these with all rays, which come first. The rest is removed. If `best` >= `finalists`, the quarter is
/// left out. `evaluate(candidate, rays)` may be called from several threads, and adds the number of cells on the rays
/// to `candidate.operations`, of which the sum is moved to `operations`. `before` as for std::stable_sort.
template <class Candidate, class Evaluate, class Before>
void rank_views(const FollowingCaster& looking, int threads, std::vector<Candidate>& candidates,
                std::size_t finalists, std::size_t best, std::uint64_t& operations, const Evaluate& evaluate,
                const Before& before) {
  const auto rank = [&](const ViewRays& rays, std::size_t first) {
    share_work(first, static_cast<std::size_t>(threads), [&](std::size_t i) { evaluate(candidates[i], rays); });
    for (std::size_t i = 0; i < first; ++i) {
      operations += std::exchange(candidates[i].operations, 0);
    }
    std::stable_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(first), before);
  };
  if (candidates.size() <= finalists) {
    rank(looking.rays(), candidates.size());
    return;
  }
  rank(looking.sparse_rays(), candidates.size());
  candidates.resize(finalists);
  if (best < finalists) {
    rank(looking.medium_rays(), finalists);
  }
  rank(looking.rays(), std::min(best, finalists));
}

}  // namespace vantage::detail
