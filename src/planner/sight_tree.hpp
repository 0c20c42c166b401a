// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// The cells that rays from the centre of a cell pass in many directions, as a tree: what rays have in common from
/// their start, they share. Where one is stopped, so are all that pass there, at once.
class SightTree {
 public:
  /// Rays of the length `furthest_m` in these directions (unit vectors).
  SightTree(const VoxelFrame& frame, std::span<const Eigen::Vector3d> directions, double furthest_m);

  /// Follows the rays from `start`, which they do not ask about: each until `clear(cell)` denies a cell or
  /// `accepts(cell)` takes one. The cell taken on the first of the directions on which one is; none if there is none.
  /// Rays are not followed into a box of cells none of which `may_accept(box)`.
  template <class MayAccept, class Clear, class Accepts>
  [[nodiscard]] std::optional<VoxelIndex> first(const VoxelIndex& start, const MayAccept& may_accept,
                                                const Clear& clear, const Accepts& accepts) const {
    Found found;
    if (!branches_.empty()) {
      follow(branches_.front(), start, may_accept, clear, accepts, found);
    }
    return found.cell;
  }

 private:
  // The cells that some rays pass together from where others have left them, or have ended.
  struct Branch {
    std::size_t direction = 0;  // the first of those that pass here
    std::size_t first_step = 0;
    std::size_t last_step = 0;
    VoxelBox reach;                    // around the cells of these and of all further branches
    std::vector<std::size_t> further;  // ascending by direction
  };
  struct Found {
    std::size_t direction = std::numeric_limits<std::size_t>::max();
    std::optional<VoxelIndex> cell;
  };

  std::size_t grow(const std::vector<std::vector<VoxelIndex>>& rays, const std::vector<std::size_t>& together,
                   std::size_t depth);

  // Branches whose directions all come after that of what has been found need no asking.
  template <class MayAccept, class Clear, class Accepts>
  void follow(const Branch& branch, const VoxelIndex& start, const MayAccept& may_accept, const Clear& clear,
              const Accepts& accepts, Found& found) const {
    if (branch.direction >= found.direction || !may_accept({start + branch.reach.lo, start + branch.reach.hi})) {
      return;
    }
    for (std::size_t step = branch.first_step; step < branch.last_step; ++step) {
      const VoxelIndex cell = start + steps_[step];
      if (!clear(cell)) {
        return;
      }
      if (accepts(cell)) {
        found = {branch.direction, cell};
        return;
      }
    }
    for (const std::size_t next : branch.further) {
      follow(branches_[next], start, may_accept, clear, accepts, found);
    }
  }

  std::vector<VoxelIndex> steps_;  // cells from the start of the rays
  std::vector<Branch> branches_;   // the first holds all others
};

}  // namespace vantage::detail
