// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <vantage/field/impl/fine_level.hpp>
#include <vantage/field/impl/lanes.hpp>

namespace vantage::detail {

/// The values of one colour in a brick and in its six neighbours.
template <class T>
struct Around {
  const T* own;
  std::array<const T*, 6> side;

  Around(const T* of_own, const std::array<const T*, 6>& of_sides) : own(of_own), side(of_sides) {}
  Around(const FineLevel& level, const HalfField<T>& field, std::size_t brick)
      : own(field.data() + brick * kHalfBrick) {
    for (std::size_t face = 0; face < 6; ++face) {
      side[face] = field.data() + level.links[brick][face] * kHalfBrick;
    }
  }
};

/// The values at the six neighbours of eight cells.
template <class T>
struct SixNeighbours {
  std::array<Lanes<T>, 6> at;

  [[nodiscard]] VANTAGE_ALWAYS_INLINE Lanes<T> sum() const {
    return ((at[0] + at[1]) + (at[2] + at[3])) + (at[4] + at[5]);
  }
};

/// The neighbours of the cells of `colour` in a row; all of them have the other colour. Along y and z they have the
/// same place in their rows. Along x, one has the same place and the other is one place higher or lower.
template <std::size_t colour, class T>
VANTAGE_ALWAYS_INLINE SixNeighbours<T> neighbours(const Around<T>& other, std::size_t row) {
  const std::size_t y = row % 8;
  const T* below_y = y > 0 ? other.own + (row - 1) * 8 : other.side[2] + (row + 7) * 8;
  const T* above_y = y < 7 ? other.own + (row + 1) * 8 : other.side[3] + (row - 7) * 8;
  const T* below_z = row >= 8 ? other.own + (row - 8) * 8 : other.side[4] + (row + 56) * 8;
  const T* above_z = row < 56 ? other.own + (row + 8) * 8 : other.side[5] + (row - 56) * 8;
  const Lanes<T> level = load(other.own + row * 8);
  const bool starts_at_one = ((row ^ row >> 3U ^ colour) & 1U) != 0;
  const Lanes<T> beside = starts_at_one ? shifted_down<T>(level, load(other.side[1] + row * 8))
                                        : shifted_up<T>(level, load(other.side[0] + row * 8));
  return {{level, beside, load(below_y), load(above_y), load(below_z), load(above_z)}};
}

/// Two layers of rows of a brick and their surroundings. If the position of a row in them is a compile-time constant,
/// so are all offsets.
template <class T>
struct TwoLayers {
  const T* rows;                 // 16 rows
  const T* below;                // the layer below, 8 rows
  const T* above;                // the layer above, 8 rows
  std::array<const T*, 4> side;  // 16 rows of each neighbour brick in x and y

  VANTAGE_ALWAYS_INLINE TwoLayers(const Around<T>& around, std::size_t pair)
      : rows(around.own + pair * 128),
        below(pair > 0 ? rows - 64 : around.side[4] + 7 * 64),
        above(pair < 3 ? rows + 128 : around.side[5]),
        side{around.side[0] + pair * 128, around.side[1] + pair * 128, around.side[2] + pair * 128,
             around.side[3] + pair * 128} {}
};

/// The neighbours of the cells of `colour` in row `i` of two layers, as above.
template <std::size_t colour, std::size_t i, class T>
VANTAGE_ALWAYS_INLINE SixNeighbours<T> neighbours(const TwoLayers<T>& other) {
  constexpr std::size_t kY = i % 8;
  constexpr bool kLower = i < 8;
  constexpr bool kStartsAtOne = ((i ^ i >> 3U ^ colour) & 1U) != 0;
  const Lanes<T> level = load(other.rows + i * 8);
  const Lanes<T> beside = kStartsAtOne ? shifted_down<T>(level, load(other.side[1] + i * 8))
                                       : shifted_up<T>(level, load(other.side[0] + i * 8));
  return {{level, beside, load(kY > 0 ? other.rows + (i - 1) * 8 : other.side[2] + (i + 7) * 8),
           load(kY < 7 ? other.rows + (i + 1) * 8 : other.side[3] + (i - 7) * 8),
           load(kLower ? other.below + i * 8 : other.rows + (i - 8) * 8),
           load(kLower ? other.rows + (i + 8) * 8 : other.above + (i - 8) * 8)}};
}

/// Rows of two layers, and rows of blocks in them.
using EachRow = std::make_index_sequence<16>;
using EachLine = std::make_index_sequence<4>;

/// 1 / degree, or 0 where there is no unknown.
template <class T>
VANTAGE_ALWAYS_INLINE Lanes<T> inverse_of(const Lanes<T>& degree) {
  return degree > T{0} ? T{1} / degree : Lanes<T>{};
}

/// red = (sum of the black neighbours) / degree: solves the red equations for a zero right hand side.
struct RedSolve {
  const std::uint32_t* faces;
  Around<float> black;
  float* red;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t pair = 0; pair < 4; ++pair) {
      const TwoLayers<float> around(black, pair);
      unrolled(
          [&](auto i) VANTAGE_ALWAYS_INLINE_LAMBDA {
            const std::size_t row = pair * 16 + i;
            const Lanes<float> sum = neighbours<kRed, i>(around).sum();
            store<float>(red + row * 8, sum * inverse_of<float>(widen<float>(faces[row], kDegree)));
          },
          EachRow{});
    }
  }
};

/// out = S black, the Schur complement after elimination of the red cells. Also sums up black * out.
struct BlackApply {
  const std::uint32_t* faces;
  const float* black;
  Around<float> red;
  float* out;
  double* dot;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    Lanes<float> sum{};
    for (std::size_t pair = 0; pair < 4; ++pair) {
      const TwoLayers<float> around(red, pair);
      unrolled(
          [&](auto i) VANTAGE_ALWAYS_INLINE_LAMBDA {
            const std::size_t row = pair * 16 + i;
            const Lanes<float> own = load(black + row * 8);
            const Lanes<float> degree = widen<float>(faces[row], kDegree);
            const Lanes<float> applied = degree * own - neighbours<kBlack, i>(around).sum();
            const Lanes<float> kept = degree > 0.0F ? applied : Lanes<float>{};
            store<float>(out + row * 8, kept);
            sum += own * kept;
          },
          EachRow{});
    }
    *dot = sum_of<float>(sum);
  }
};

/// The residual right - S black, summed over the cells of each block.
struct BlackRestrict {
  const std::uint32_t* faces;
  const float* right;
  const float* black;
  Around<float> red;
  float* blocks;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t pair = 0; pair < 4; ++pair) {
      const TwoLayers<float> around(red, pair);
      unrolled(
          [&](auto line) VANTAGE_ALWAYS_INLINE_LAMBDA {
            store<float>(blocks + (pair * 4 + line) * 8,
                         (residual<2 * line>(around, pair) + residual<2 * line + 1>(around, pair)) +
                             (residual<2 * line + 8>(around, pair) + residual<2 * line + 9>(around, pair)));
          },
          EachLine{});
    }
  }

 private:
  template <std::size_t i>
  VANTAGE_ALWAYS_INLINE Lanes<float> residual(const TwoLayers<float>& around, std::size_t pair) const {
    const std::size_t row = pair * 16 + i;
    const Lanes<float> degree = widen<float>(faces[row], kDegree);
    const Lanes<float> all_cells =
        load(right + row * 8) - (degree * load(black + row * 8) - neighbours<kBlack, i>(around).sum());
    return degree > 0.0F ? all_cells : Lanes<float>{};
  }
};

/// black += correction of its block.
struct BlackProlong {
  const std::uint32_t* faces;
  const float* blocks;
  float* black;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<float> degree = widen<float>(faces[row], kDegree);
      const Lanes<float> correction = load(blocks + (row / 16 * 4 + row % 8 / 2) * 8);
      store<float>(black + row * 8, load(black + row * 8) + (degree > 0.0F ? correction : Lanes<float>{}));
    }
  }
};

/// Relaxes the black cells once with `weight`. Sums up right * black afterwards.
struct BlackSmooth {
  const std::uint32_t* faces;
  const float* right;
  Around<float> red;
  float* black;
  float weight;
  double* dot;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    Lanes<float> sum{};
    for (std::size_t pair = 0; pair < 4; ++pair) {
      const TwoLayers<float> around(red, pair);
      unrolled(
          [&](auto i) VANTAGE_ALWAYS_INLINE_LAMBDA {
            const std::size_t row = pair * 16 + i;
            const Lanes<float> degree = widen<float>(faces[row], kDegree);
            const Lanes<float> own = load(black + row * 8);
            const Lanes<float> load_here = load(right + row * 8);
            const Lanes<float> residual = load_here - (degree * own - neighbours<kBlack, i>(around).sum());
            const Lanes<float> smoothed = own + weight * residual * inverse_of<float>(degree);
            store<float>(black + row * 8, smoothed);
            sum += smoothed * load_here;
          },
          EachRow{});
    }
    *dot = sum_of<float>(sum);
  }
};

/// Start of conjugate gradients: x = 0 and the first relaxation z = weight r / degree. Sums up r * r.
struct Begin {
  const std::uint32_t* faces;
  const float* r;
  float* x;
  float* z;
  float weight;
  double* square;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    Lanes<float> sum{};
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<float> residual = load(r + row * 8);
      store<float>(x + row * 8, Lanes<float>{});
      store<float>(z + row * 8, weight * residual * inverse_of<float>(widen<float>(faces[row], kDegree)));
      sum += residual * residual;
    }
    *square = sum_of<float>(sum);
  }
};

/// One step of conjugate gradients and the first relaxation of the new residual: x += step p, r -= step q, z = weight
/// r / degree. Sums up r * r.
struct Advance {
  const std::uint32_t* faces;
  const float* p;
  const float* q;
  float* x;
  float* r;
  float* z;
  float step;
  float weight;
  double* square;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    Lanes<float> sum{};
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const std::size_t at = row * 8;
      const Lanes<float> residual = load(r + at) - step * load(q + at);
      store<float>(x + at, load(x + at) + step * load(p + at));
      store<float>(r + at, residual);
      store<float>(z + at, weight * residual * inverse_of<float>(widen<float>(faces[row], kDegree)));
      sum += residual * residual;
    }
    *square = sum_of<float>(sum);
  }
};

/// p = z + share p.
struct Turn {
  const float* z;
  float* p;
  float share;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t at = 0; at < kHalfBrick; at += kLanes) {
      store<float>(p + at, load(z + at) + share * load(p + at));
    }
  }
};

}  // namespace vantage::detail
