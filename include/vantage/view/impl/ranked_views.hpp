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
/// with few rays, which tells most of them apart, and again only the best of them with `rays`. `evaluate(candidate,
/// rays)` may be called from several threads, and adds the number of cells on the rays to `candidate.operations`, of
/// which the sum is moved to `operations`. `before` as for std::stable_sort.
template <class Candidate, class Evaluate, class Before>
void rank_views(const FollowingCaster& looking, int threads, std::vector<Candidate>& candidates,
                std::size_t finalists, const ViewRays& rays, std::uint64_t& operations, const Evaluate& evaluate,
                const Before& before) {
  const auto rank = [&](const ViewRays& with) {
    share_work(candidates.size(), static_cast<std::size_t>(threads),
               [&](std::size_t i) { evaluate(candidates[i], with); });
    for (Candidate& candidate : candidates) {
      operations += std::exchange(candidate.operations, 0);
    }
    std::stable_sort(candidates.begin(), candidates.end(), before);
  };
  if (candidates.size() > finalists) {
    rank(looking.sparse_rays());
    candidates.resize(finalists);
  }
  rank(rays);
}

}  // namespace vantage::detail
