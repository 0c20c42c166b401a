// SPDX-License-Identifier: MIT
#include "field/block_level.hpp"

#include <algorithm>
#include <array>

#include "field/lanes.hpp"

namespace vantage::detail {
namespace {

// Rows couple along x within themselves, which is relaxed with the old values (Jacobi): by a little less than fully,
// so that it still smooths where a corridor leaves nothing but that.
constexpr float kBlockWeight = 0.95F;

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
  [[nodiscard]] VANTAGE_INLINE BlockSums sums() const {
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
      const Lanes<std::uint32_t> faces = counts >> (3U * face) & 7U;
      const Lanes<float> conductance =
          __builtin_convertvector(reinterpret_cast<const Lanes<std::int32_t>&>(faces), Lanes<float>);
      sums.inflow += conductance * neighbour[face];
      sums.diagonal += conductance;
    }
    const Lanes<std::uint32_t> leaks = counts >> 18U;
    sums.inflow *= 0.5F;
    sums.diagonal = 0.5F * sums.diagonal +
                    __builtin_convertvector(reinterpret_cast<const Lanes<std::int32_t>&>(leaks), Lanes<float>);
    return sums;
  }
};

// Relaxes the lines whose y + z is of one parity.
template <std::size_t parity>
struct Smooth {
  BlocksAround around;
  const float* right;
  float* x;

  VANTAGE_INLINE void operator()() const {
    unrolled(
        [&](auto i) VANTAGE_INLINE_LAMBDA {
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

  VANTAGE_INLINE void operator()() const {
    unrolled(
        [&](auto line) VANTAGE_INLINE_LAMBDA {
          const BlockSums sums = around.sums<line>();
          store<float>(residual + line * 8,
                       load(right + line * 8) - (sums.diagonal * load(around.own + line * 8) - sums.inflow));
        },
        std::make_index_sequence<16>{});
  }
};

}  // namespace

BlockLevel::BlockLevel(const FineLevel& fine) {
  clear(fine, x, kBrickBlocks);
  clear(fine, right, kBrickBlocks);
}

void BlockLevel::smooth(const FineLevel& fine, bool even_first) {
  for (const bool even : {even_first, !even_first}) {
    for_bricks(fine, [&](std::size_t brick) {
      // The parity changes from brick to brick along x, or rows relaxed together would meet there.
      const bool flipped = (fine.address[brick].x & 1) != 0;
      const BlocksAround around(fine, x, brick);
      const float* load_here = right.data() + brick * kBrickBlocks;
      float* own = x.data() + brick * kBrickBlocks;
      if (even == flipped) {
        run(Smooth<1>{around, load_here, own});
      } else {
        run(Smooth<0>{around, load_here, own});
      }
    });
  }
}

void BlockLevel::restrict_to(const FineLevel& fine, std::vector<float>& sums) const {
  std::fill(sums.begin(), sums.end(), 0.0F);
  const std::size_t nodes = sums.size() - 1;
  for_bricks(fine, [&](std::size_t brick) {
    std::array<float, kBrickBlocks> residual{};
    run(Residual{BlocksAround(fine, x, brick), right.data() + brick * kBrickBlocks, residual.data()});
    for (std::size_t i = 0; i < kBrickBlocks; ++i) {
      if (const std::uint32_t to = node[brick * kBrickBlocks + i]; to < nodes) {
        sums[to] += residual[i];  // all its blocks are in this brick
      }
    }
  });
}

void BlockLevel::prolong(const FineLevel& fine, const std::vector<float>& correction) {
  for_bricks(fine, [&](std::size_t brick) {
    for (std::size_t i = brick * kBrickBlocks; i < (brick + 1) * kBrickBlocks; ++i) {
      x[i] += correction[node[i]];
    }
  });
}

}  // namespace vantage::detail
