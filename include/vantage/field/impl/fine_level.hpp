// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/map/impl/instruction_set.hpp>
#include <vector>

#include <vantage/field/impl/aligned_vector.hpp>
#include <vantage/field/impl/cell_values.hpp>
#include <vantage/field/impl/thread_team.hpp>

namespace vantage::detail {

/// Rows of a brick along x; each holds eight cells of either colour.
inline constexpr std::size_t kBrickRows = 64;
/// Blocks of 2 x 2 x 2 cells in a brick: 8 along x, 4 along y and z.
inline constexpr std::size_t kBrickBlocks = 128;
/// Masks for the four bits of a cell: number of open faces, and whether a neighbour is a sink.
inline constexpr std::uint32_t kDegree = 7;
inline constexpr std::uint32_t kBesideSink = 8;

/// The bricks of one thread. In the second and third of three passes, the bricks near another thread's bricks are
/// handled late, after all threads have finished the others.
struct BrickShare {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::vector<std::uint32_t> late_second;  ///< bricks with a neighbour in another share
  std::vector<std::uint32_t> late_third;   ///< bricks adjacent to a brick of `late_second`, or in it
};

/// The 7-point operator over the cells of a domain, with 0 at the sinks: A u = degree * u - sum of the neighbours.
/// The degree is the number of open faces; u is stored as 0 where there is no unknown.
///
/// Cells of a brick are stored by colour, then by z, y and x. Bricks are numbered from 1. Brick 0 is empty and stands
/// for missing neighbours.
struct FineLevel {
  InstructionSet set = best_instruction_set();      ///< for which the kernels are compiled
  std::size_t brick_count = 0;                      ///< includes the empty brick 0
  std::vector<VoxelIndex> address;                  ///< address of each brick, in units of bricks
  std::vector<std::array<std::uint32_t, 6>> links;  ///< numbers of the neighbour bricks
  std::vector<std::uint32_t> ready;                 ///< the largest of a brick's own number and its neighbours'
  /// Per colour and row, four bits per cell: the number of open faces (0 if there is no unknown) and kBesideSink.
  std::array<AlignedVector<std::uint32_t>, 2> faces;
  AlignedVector<std::uint32_t> blocks;  ///< operator of the blocks, see BlockLevel
  std::unique_ptr<ThreadTeam> team;
  std::vector<BrickShare> shares;    ///< one per thread
  std::vector<std::uint8_t> passes;  ///< how many of the three passes a brick takes part in without being late

  /// Number of open faces of a cell.
  [[nodiscard]] std::uint32_t degree(std::size_t colour, std::size_t brick, std::size_t offset) const {
    return faces[colour][brick * kBrickRows + offset / 8] >> (4 * (offset % 8)) & kDegree;
  }
  [[nodiscard]] std::size_t memory_bytes() const;
};

/// Builds the operator of a domain that has no isolated cells. The bricks keep their order. Uses at most `threads`
/// threads for this and all later passes.
[[nodiscard]] FineLevel make_fine_level(const LaplaceDomain& domain, std::size_t threads = 1);

/// Calls `each` for every brick; in order within a share.
template <class Each>
void for_bricks(const FineLevel& fine, const Each& each) {
  fine.team->run([&](std::size_t i) {
    for (std::size_t brick = fine.shares[i].begin; brick < fine.shares[i].end; ++brick) {
      each(brick);
    }
  });
}

/// Allocates `per_brick` numbers per brick. They are zero in the empty brick 0 and uninitialised elsewhere.
template <class T>
void make_room(const FineLevel& fine, AlignedVector<T>& values, std::size_t per_brick) {
  values.resize(fine.brick_count * per_brick);
  std::fill_n(values.data(), per_brick, T{});
}

/// Sets `per_brick` numbers per brick to zero.
template <class T>
void clear(const FineLevel& fine, AlignedVector<T>& values, std::size_t per_brick) {
  make_room(fine, values, per_brick);
  for_bricks(fine, [&](std::size_t brick) { std::fill_n(values.data() + brick * per_brick, per_brick, T{}); });
}

/// Runs three passes over the bricks in one sweep. `second` runs on a brick as soon as `first` has run on it and on
/// its neighbours; `third` follows `second` in the same way. So the data of one pass are still in the cache for the
/// next.
template <class First, class Second, class Third>
void in_waves(const FineLevel& fine, const First& first, const Second& second, const Third& third) {
  fine.team->run([&](std::size_t i) {
    std::size_t b = fine.shares[i].begin;
    std::size_t c = b;
    for (std::size_t a = b; a < fine.shares[i].end; ++a) {
      first(a);
      for (; b <= a && (fine.ready[b] <= a || fine.passes[b] < 2); ++b) {
        if (fine.passes[b] >= 2) {
          second(b);
        }
      }
      for (; c < b && (fine.ready[c] < b || fine.passes[c] < 3); ++c) {
        if (fine.passes[c] >= 3) {
          third(c);
        }
      }
    }
  });
  if (fine.shares.size() == 1) {
    return;
  }
  fine.team->run([&](std::size_t i) {
    std::for_each(fine.shares[i].late_second.begin(), fine.shares[i].late_second.end(), second);
  });
  fine.team->run([&](std::size_t i) {
    std::for_each(fine.shares[i].late_third.begin(), fine.shares[i].late_third.end(), third);
  });
}

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/fine_level.ipp>
#endif
