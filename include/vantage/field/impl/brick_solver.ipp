// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/brick_solver.hpp>

#include <cmath>
#include <numeric>
#include <utility>

namespace vantage::detail {

// Over-relaxation of the black cells. Their Schur complement, scaled, has its spectrum in (0, 1].
inline constexpr float kBlackWeight = 1.15F;

template <class Field>
auto* at(Field& field, std::size_t brick) {
  return field.data() + brick * kHalfBrick;
}

VANTAGE_INLINE BrickSolver::BrickSolver(FineLevel fine)
    : fine_(std::move(fine)), coarse_(fine_), sums_(fine_.brick_count, 0.0) {
  for (HalfField<float>* field : {&r_, &z_, &q_, &red_}) {
    make_room(fine_, *field, kHalfBrick);
  }
  for (HalfField<float>* field : {&x_, &p_}) {
    clear(fine_, *field, kHalfBrick);  // read before they are written
  }
}

VANTAGE_INLINE double BrickSolver::total() const { return std::accumulate(sums_.begin(), sums_.end(), 0.0); }

// Runs `first` on every brick, which must leave z relaxed once, and restricts the residual of z to the blocks.
// Returns r * r.
template <class First>
double BrickSolver::way_down(const First& first) {
  in_waves(
      fine_, first,
      [&](std::size_t b) {
        compiled_for(fine_.set,
                     RedSolve{fine_.faces[kRed].data() + b * kBrickRows, Around<float>(fine_, z_, b), at(red_, b)});
      },
      [&](std::size_t b) {
        compiled_for(fine_.set, BlackRestrict{fine_.faces[kBlack].data() + b * kBrickRows, at(r_, b), at(z_, b),
                                              Around<float>(fine_, red_, b), coarse_.right(b)});
      });
  return total();
}

// x = 0, then the downward part.
VANTAGE_INLINE double BrickSolver::begin() {
  return way_down([&](std::size_t b) {
    compiled_for(fine_.set, Begin{fine_.faces[kBlack].data() + b * kBrickRows, at(r_, b), at(x_, b), at(z_, b),
                                  kBlackWeight, &sums_[b]});
  });
}

// x += step p, r -= step q, then the downward part.
VANTAGE_INLINE double BrickSolver::advance(float step) {
  return way_down([&](std::size_t b) {
    compiled_for(fine_.set, Advance{fine_.faces[kBlack].data() + b * kBrickRows, at(p_, b), at(q_, b), at(x_, b),
                                    at(r_, b), at(z_, b), step, kBlackWeight, &sums_[b]});
  });
}

// The coarse correction and the last relaxation. Returns r * z.
VANTAGE_INLINE double BrickSolver::correct() {
  coarse_.solve(fine_);
  in_waves(
      fine_,
      [&](std::size_t b) {
        compiled_for(fine_.set,
                     BlackProlong{fine_.faces[kBlack].data() + b * kBrickRows, coarse_.correction(b), at(z_, b)});
      },
      [&](std::size_t b) {
        compiled_for(fine_.set,
                     RedSolve{fine_.faces[kRed].data() + b * kBrickRows, Around<float>(fine_, z_, b), at(red_, b)});
      },
      [&](std::size_t b) {
        compiled_for(fine_.set, BlackSmooth{fine_.faces[kBlack].data() + b * kBrickRows, at(r_, b),
                                            Around<float>(fine_, red_, b), at(z_, b), kBlackWeight, &sums_[b]});
      });
  return total();
}

// p = z + share p, q = S p. Returns p * q.
VANTAGE_INLINE double BrickSolver::turn(float share) {
  in_waves(
      fine_,
      [&](std::size_t b) {
        compiled_for(fine_.set, Turn{at(z_, b), at(p_, b), share});
      },
      [&](std::size_t b) {
        compiled_for(fine_.set,
                     RedSolve{fine_.faces[kRed].data() + b * kBrickRows, Around<float>(fine_, p_, b), at(red_, b)});
      },
      [&](std::size_t b) {
        compiled_for(fine_.set, BlackApply{fine_.faces[kBlack].data() + b * kBrickRows, at(p_, b),
                                           Around<float>(fine_, red_, b), at(q_, b), &sums_[b]});
      });
  return total();
}

VANTAGE_INLINE std::size_t BrickSolver::solve(double reduction, std::size_t most) {
  const double stop = reduction * reduction * begin();
  std::size_t iterations = 0;
  double previous = 0.0;
  while (iterations < most) {
    const double along = correct();
    const double curvature = turn(previous > 0.0 ? static_cast<float>(along / previous) : 0.0F);
    if (!(along > 0.0 && curvature > 0.0)) {
      break;  // solved exactly, or at the limit of single precision
    }
    previous = along;
    ++iterations;
    if (advance(static_cast<float>(along / curvature)) <= stop) {
      break;
    }
  }
  return iterations;
}

VANTAGE_INLINE void BrickSolver::precondition(HalfField<float>& out) {
  begin();
  correct();
  out = z_;
}

VANTAGE_INLINE void BrickSolver::apply(const HalfField<float>& in, HalfField<float>& out) {
  z_ = in;
  turn(0.0F);
  out = q_;
}

VANTAGE_INLINE std::size_t BrickSolver::memory_bytes() const {
  return fine_.memory_bytes() + coarse_.memory_bytes() + bytes_of(sums_) + 6 * bytes_of(x_);
}

}  // namespace vantage::detail
