// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// Rays from the centre of a cell in many directions, as a tree of cells. Rays share the cells that they have in
/// common from their start. Where a cell blocks, all rays through it end at once.
///
///     start --+-- cell -- cell --+-- cell ...     ray 0
///             |                  +-- cell ...     ray 1
///             +-- cell ...                        ray 2
class SightTree {
 public:
  /// Whether a sensor can have in view what lies along this line (world frame, of any length but zero).
  using MayFace = std::function<bool(const Eigen::Vector3d& line)>;

  /// Rays of length `furthest_m`, metres, in these directions (unit vectors). Each ends at the last cell from which a
  /// sensor may have the start of the rays in view, or a face neighbour of it.
  SightTree(const VoxelFrame& frame, std::span<const Eigen::Vector3d> directions, double furthest_m,
            const MayFace& may_face);

  /// Follows the rays from `start`, which itself is not tested. Each ray ends at the first cell where `passes(cell)`
  /// is false or `accepts(cell)` is true. Returns the accepted cell of the first ray, in the order of directions,
  /// that has one; none if no ray has. Rays do not enter a box of cells for which `may_accept(box)` is false.
  template <class MayAccept, class Passes, class Accepts>
  [[nodiscard]] std::optional<VoxelIndex> first(const VoxelIndex& start, const MayAccept& may_accept,
                                                const Passes& passes, const Accepts& accepts) const {
    Found found;
    if (!branches_.empty() && may_accept(reach_from(start, branches_.front()))) {
      follow(branches_.front(), start, may_accept, passes, accepts, found);
    }
    return found.cell;
  }

 private:
  // Cells that several rays have in common, up to where they part or one ends.
  struct Branch {
    std::size_t direction = 0;  // the first ray of this branch
    std::size_t first_step = 0;
    std::size_t last_step = 0;
    VoxelBox reach;                    // bounding box of the cells of this and all further branches
    std::vector<std::size_t> further;  // ascending by direction
  };
  struct Found {
    std::size_t direction = std::numeric_limits<std::size_t>::max();
    std::optional<VoxelIndex> cell;
  };

  std::size_t grow(const std::vector<std::vector<VoxelIndex>>& rays, const std::vector<std::size_t>& together,
                   std::size_t depth);

  static VoxelBox reach_from(const VoxelIndex& start, const Branch& branch) {
    return {start + branch.reach.lo, start + branch.reach.hi};
  }

  // Skips branches whose rays all come after the result found so far.
  template <class MayAccept, class Passes, class Accepts>
  void follow(const Branch& branch, const VoxelIndex& start, const MayAccept& may_accept, const Passes& passes,
              const Accepts& accepts, Found& found) const {
    if (branch.direction >= found.direction) {
      return;
    }
    for (std::size_t step = branch.first_step; step < branch.last_step; ++step) {
      const VoxelIndex cell = start + steps_[step];
      if (!passes(cell)) {
        return;
      }
      // Asked behind the first cell, where many branches end.
      if (step == branch.first_step && !may_accept(reach_from(start, branch))) {
        return;
      }
      if (accepts(cell)) {
        found = {branch.direction, cell};
        return;
      }
    }
    for (const std::size_t next : branch.further) {
      follow(branches_[next], start, may_accept, passes, accepts, found);
    }
  }

  std::vector<VoxelIndex> steps_;  // cells relative to the start
  std::vector<Branch> branches_;   // the first one is the root
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/sight_tree.ipp>
#endif
