// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/block_level.hpp>

#include <algorithm>
#include <array>

#include <vantage/field/impl/lanes.hpp>

namespace vantage::detail {

// Blocks of one row depend on each other along x and are relaxed with old values (Jacobi). A weight below 1 keeps
// this smoothing even in a corridor along x, where only these couplings exist.
inline constexpr float kBlockWeight = 0.95F;

VANTAGE_ALWAYS_INLINE Lanes<float> as_floats(const Lanes<std::uint32_t>& counts) {
  return __builtin_convertvector(reinterpret_cast<const Lanes<std::int32_t>&>(counts), Lanes<float>);
}

// The sum of all conductances.
VANTAGE_ALWAYS_INLINE Lanes<float> diagonal_of(const Lanes<std::uint32_t>& packed) {
  return 0.5F * as_floats(packed >> 18U);
}

struct BlockSums {
  Lanes<float> inflow;    // sum of conductance * neighbour
  Lanes<float> diagonal;  // sum of all conductances
};

// The blocks of a brick and of its six neighbours.
struct BlocksAround {
  const std::uint32_t* packed;
  const float* own;
  std::array<const float*, 6> side;

  BlocksAround(const FineLevel& fine, const AlignedVector<float>& x, std::size_t brick)
      : packed(fine.blocks.data() + brick * kBrickBlocks), own(x.data() + brick * kBrickBlocks) {
    for (std::size_t face = 0; face < 6; ++face) {
      side[face] = x.data() + fine.links[brick][face] * kBrickBlocks;
    }
  }
  // `line` is z * 4 + y.
  template <std::size_t line>
  [[nodiscard]] VANTAGE_ALWAYS_INLINE BlockSums sums() const {
    constexpr std::size_t kY = line % 4;
    const Lanes<float> here = load(own + line * 8);
    const std::array<Lanes<float>, 6> neighbour{shifted_up<float>(here, load(side[0] + line * 8)),
                                                shifted_down<float>(here, load(side[1] + line * 8)),
                                                load(kY > 0 ? own + (line - 1) * 8 : side[2] + (line + 3) * 8),
                                                load(kY < 3 ? own + (line + 1) * 8 : side[3] + (line - 3) * 8),
                                                load(line >= 4 ? own + (line - 4) * 8 : side[4] + (line + 12) * 8),
                                                load(line < 12 ? own + (line + 4) * 8 : side[5] + (line - 12) * 8)};
    const Lanes<std::uint32_t> counts = load(packed + line * 8);
    BlockSums sums{};
    for (std::uint32_t face = 0; face < 6; ++face) {
      sums.inflow += as_floats(counts >> (3U * face) & 7U) * neighbour[face];
    }
    sums.inflow *= 0.5F;
    sums.diagonal = diagonal_of(counts);
    return sums;
  }
};

// As Smooth below, for x = 0 everywhere. It overwrites x without reading it.
template <std::size_t parity>
struct SmoothFromZero {
  const std::uint32_t* packed;
  const float* right;
  float* x;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    unrolled(
        [&](auto line) VANTAGE_ALWAYS_INLINE_LAMBDA {
          constexpr bool kRelaxed = ((line / 4 ^ line ^ parity) & 1U) == 0;
          Lanes<float> relaxed{};
          if constexpr (kRelaxed) {
            const Lanes<float> diagonal = diagonal_of(load(packed + line * 8));
            relaxed = diagonal > 0.0F ? kBlockWeight * (load(right + line * 8) / diagonal) : relaxed;
          }
          store<float>(x + line * 8, relaxed);
        },
        std::make_index_sequence<16>{});
  }
};

// Relaxes the rows whose y + z has the given parity.
template <std::size_t parity>
struct Smooth {
  BlocksAround around;
  const float* right;
  float* x;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    unrolled(
        [&](auto i) VANTAGE_ALWAYS_INLINE_LAMBDA {
          constexpr std::size_t kZ = i / 2;
          constexpr std::size_t kLine = kZ * 4 + i % 2 * 2 + ((kZ ^ parity) & 1U);
          const BlockSums sums = around.sums<kLine>();
          const Lanes<float> own = load(x + kLine * 8);
          const Lanes<float> step = (load(right + kLine * 8) + sums.inflow) / sums.diagonal - own;
          store<float>(x + kLine * 8, sums.diagonal > 0.0F ? own + kBlockWeight * step : own);
        },
        std::make_index_sequence<8>{});
  }
};

struct Residual {
  BlocksAround around;
  const float* right;
  float* residual;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    unrolled(
        [&](auto line) VANTAGE_ALWAYS_INLINE_LAMBDA {
          const BlockSums sums = around.sums<line>();
          store<float>(residual + line * 8,
                       load(right + line * 8) - (sums.diagonal * load(around.own + line * 8) - sums.inflow));
        },
        std::make_index_sequence<16>{});
  }
};

VANTAGE_INLINE BlockLevel::BlockLevel(const FineLevel& fine) {
  make_room(fine, x, kBrickBlocks);
  make_room(fine, right, kBrickBlocks);
}

// Parities alternate between adjacent bricks along x. Otherwise rows that are relaxed together would be adjacent
// across the bricks' border.
inline bool is_flipped(const FineLevel& fine, std::size_t brick) { return (fine.address[brick].x & 1) != 0; }

VANTAGE_INLINE void BlockLevel::begin(const FineLevel& fine, std::size_t brick) {
  const std::size_t at = brick * kBrickBlocks;
  if (is_flipped(fine, brick)) {
    compiled_for(fine.set, SmoothFromZero<1>{fine.blocks.data() + at, right.data() + at, x.data() + at});
  } else {
    compiled_for(fine.set, SmoothFromZero<0>{fine.blocks.data() + at, right.data() + at, x.data() + at});
  }
}

VANTAGE_INLINE void BlockLevel::relax(const FineLevel& fine, std::size_t brick, bool even) {
  const BlocksAround around(fine, x, brick);
  const std::size_t at = brick * kBrickBlocks;
  if (even == is_flipped(fine, brick)) {
    compiled_for(fine.set, Smooth<1>{around, right.data() + at, x.data() + at});
  } else {
    compiled_for(fine.set, Smooth<0>{around, right.data() + at, x.data() + at});
  }
}

VANTAGE_INLINE void BlockLevel::restrict_brick(const FineLevel& fine, std::size_t brick,
                                               AlignedVector<float>& sums) const {
  std::array<float, kBrickBlocks> residual{};
  compiled_for(fine.set,
               Residual{BlocksAround(fine, x, brick), right.data() + brick * kBrickBlocks, residual.data()});
  const std::size_t nodes = sums.size() - 1;
  for (std::size_t i = 0; i < kBrickBlocks; ++i) {
    if (const std::uint32_t to = node[brick * kBrickBlocks + i]; to < nodes) {
      sums[to] += residual[i];  // safe with threads: all blocks of a node are in this brick
    }
  }
}

VANTAGE_INLINE void BlockLevel::descend(const FineLevel& fine, AlignedVector<float>& sums) {
  in_waves(
      fine, [&](std::size_t b) { begin(fine, b); }, [&](std::size_t b) { relax(fine, b, false); },
      [&](std::size_t b) { relax(fine, b, true); });
  std::fill(sums.begin(), sums.end(), 0.0F);
  in_waves(
      fine, [&](std::size_t b) { relax(fine, b, false); }, [&](std::size_t b) { restrict_brick(fine, b, sums); },
      [](std::size_t) {});
}

VANTAGE_INLINE void BlockLevel::ascend(const FineLevel& fine, const AlignedVector<float>& correction) {
  in_waves(
      fine,
      [&](std::size_t b) {
        for (std::size_t i = b * kBrickBlocks; i < (b + 1) * kBrickBlocks; ++i) {
          x[i] += correction[node[i]];
        }
      },
      [&](std::size_t b) { relax(fine, b, false); }, [&](std::size_t b) { relax(fine, b, true); });
  in_waves(
      fine, [&](std::size_t b) { relax(fine, b, false); }, [&](std::size_t b) { relax(fine, b, true); },
      [](std::size_t) {});
}

}  // namespace vantage::detail
