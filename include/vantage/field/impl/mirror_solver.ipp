// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/field/impl/mirror_solver.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vantage::detail {

using Field = std::array<HalfField<double>, 2>;

// out = (sum of weights) * own - sum of weight * neighbour, for one colour of a brick.
template <std::size_t colour>
struct MirrorApply {
  std::array<const std::uint32_t*, 6> weights;
  const double* own;
  Around<double> other;
  double* out;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const SixNeighbours<double> beside = neighbours<colour>(other, row);
      // The neighbour at the same place in its row is the upper one along x if the cells of this colour start at x =
      // 0, otherwise the lower one.
      const std::size_t level = ((row ^ row >> 3U ^ colour) & 1U) != 0 ? 0 : 1;
      Lanes<double> total{};
      Lanes<double> inflow{};
      for (std::size_t n = 0; n < 6; ++n) {
        const std::size_t face = n == 0 ? level : n == 1 ? 1 - level : n;
        const Lanes<double> weight = widen<double>(weights[face][row], 3U);
        total += weight;
        inflow += weight * beside.at[n];
      }
      store<double>(out + row * 8, total * load(own + row * 8) - inflow);
    }
  }
};

// out_red = (r_red + sum of out_black) / degree.
struct SpreadToRed {
  const std::uint32_t* faces;
  const double* right;
  Around<float> black;
  double* red;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<double> sum = __builtin_convertvector(neighbours<kRed>(black, row).sum(), Lanes<double>);
      store<double>(red + row * 8,
                    (load(right + row * 8) + sum) * inverse_of<double>(widen<double>(faces[row], kDegree)));
    }
  }
};

// The right hand side of the Schur complement, r_black + sum of r_red / degree, in single precision.
struct GatherFromRed {
  const std::uint32_t* faces;
  const double* right;
  Around<double> red;  // already divided by the degree
  double scale;
  float* black;

  VANTAGE_ALWAYS_INLINE void operator()() const {
    for (std::size_t row = 0; row < kBrickRows; ++row) {
      const Lanes<double> sum = scale * (load(right + row * 8) + neighbours<kBlack>(red, row).sum());
      const Lanes<double> kept = widen<double>(faces[row], kDegree) > 0.0 ? sum : Lanes<double>{};
      store<float>(black + row * 8, __builtin_convertvector(kept, Lanes<float>));
    }
  }
};

inline double dot(const Field& a, const Field& b) {
  double sum = 0.0;
  for (const std::size_t colour : {kRed, kBlack}) {
    for (std::size_t i = 0; i < a[colour].size(); ++i) {
      sum += a[colour][i] * b[colour][i];
    }
  }
  return sum;
}

// a += share * b.
inline void add(Field& a, double share, const Field& b) {
  for (const std::size_t colour : {kRed, kBlack}) {
    for (std::size_t i = 0; i < a[colour].size(); ++i) {
      a[colour][i] += share * b[colour][i];
    }
  }
}

inline Field zeros(const FineLevel& fine) {
  return {HalfField<double>(fine.brick_count * kHalfBrick, 0.0),
          HalfField<double>(fine.brick_count * kHalfBrick, 0.0)};
}

inline bool is_open(const LaplaceDomain& domain, const VoxelIndex& cell) { return domain.contains(cell); }

VANTAGE_INLINE MirrorSolver::MirrorSolver(const LaplaceDomain& domain, BrickSolver& preconditioner,
                                          const CellPlace& source, double uniform)
    : preconditioner_(preconditioner), source_(source), uniform_(uniform) {
  const FineLevel& fine = preconditioner.fine();
  for (auto& of_colour : weights_) {
    for (auto& of_face : of_colour) {
      of_face.assign(fine.brick_count * kBrickRows, 0);
    }
  }
  for (Field* field : {&u_.u, &r_, &shadow_, &p_, &v_, &t_, &p_hat_, &s_hat_}) {
    *field = zeros(fine);
  }
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    const VoxelIndex& at = fine.address[b];
    for (std::size_t i = 0; i < 2 * kHalfBrick; ++i) {
      const std::size_t row = i / 16;
      const std::size_t x = i % 16;
      const std::size_t colour = colour_of(row, x);
      if (fine.degree(colour, b, half_offset(row, x)) == 0) {
        continue;
      }
      const VoxelIndex cell{at.x * 16 + static_cast<std::int32_t>(x), at.y * 8 + static_cast<std::int32_t>(row % 8),
                            at.z * 8 + static_cast<std::int32_t>(row / 8)};
      for (std::size_t face = 0; face < 6; ++face) {
        if (is_open(domain, cell + kFaceNeighbours[face])) {
          const std::uint32_t counts = is_open(domain, cell + kFaceNeighbours[face ^ 1U]) ? 1U : 2U;
          weights_[colour][face][b * kBrickRows + row] |= counts << (4 * (x / 2));
        }
      }
    }
  }
}

VANTAGE_INLINE void MirrorSolver::apply(const Field& in, Field& out) const {
  const FineLevel& fine = preconditioner_.fine();
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    const auto weights = [&](std::size_t colour) {
      std::array<const std::uint32_t*, 6> of{};
      for (std::size_t face = 0; face < 6; ++face) {
        of[face] = weights_[colour][face].data() + b * kBrickRows;
      }
      return of;
    };
    run(MirrorApply<kRed>{weights(kRed), in[kRed].data() + b * kHalfBrick, Around<double>(fine, in[kBlack], b),
                          out[kRed].data() + b * kHalfBrick});
    run(MirrorApply<kBlack>{weights(kBlack), in[kBlack].data() + b * kHalfBrick, Around<double>(fine, in[kRed], b),
                            out[kBlack].data() + b * kHalfBrick});
  }
}

VANTAGE_INLINE void MirrorSolver::precondition(const Field& in, Field& out) {
  const FineLevel& fine = preconditioner_.fine();
  const double scale = std::sqrt(dot(in, in));
  if (!(scale > 0.0)) {
    out = in;
    return;
  }
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    for (std::size_t i = 0; i < kHalfBrick; ++i) {
      const std::uint32_t degree = fine.degree(kRed, b, i);
      out[kRed][b * kHalfBrick + i] = degree > 0 ? in[kRed][b * kHalfBrick + i] / degree : 0.0;
    }
  }
  HalfField<float>& right = preconditioner_.right();
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    run(GatherFromRed{fine.faces[kBlack].data() + b * kBrickRows, in[kBlack].data() + b * kHalfBrick,
                      Around<double>(fine, out[kRed], b), 1.0 / scale, right.data() + b * kHalfBrick});
  }
  preconditioner_.precondition(cycle_);
  for (std::size_t i = 0; i < cycle_.size(); ++i) {
    cycle_[i] = static_cast<float>(scale * static_cast<double>(cycle_[i]));
    out[kBlack][i] = static_cast<double>(cycle_[i]);
  }
  for (std::size_t b = 1; b < fine.brick_count; ++b) {
    run(SpreadToRed{fine.faces[kRed].data() + b * kBrickRows, in[kRed].data() + b * kHalfBrick,
                    Around<float>(fine, cycle_, b), out[kRed].data() + b * kHalfBrick});
  }
}

// Recomputes r = b - A u.
VANTAGE_INLINE void MirrorSolver::take_residual() {
  const FineLevel& fine = preconditioner_.fine();
  apply(u_.u, r_);
  for (const std::size_t colour : {kRed, kBlack}) {
    for (std::size_t b = 1; b < fine.brick_count; ++b) {
      for (std::size_t i = 0; i < kHalfBrick; ++i) {
        double& r = r_[colour][b * kHalfBrick + i];
        r = fine.degree(colour, b, i) > 0 ? uniform_ - r : 0.0;
      }
    }
  }
  r_[source_.colour][source_.brick * kHalfBrick + source_.offset] += 1.0;
}

VANTAGE_INLINE std::size_t MirrorSolver::solve(double norm, std::size_t most) {
  take_residual();
  // the preconditioner spreads the first residual, which is concentrated in the source's cell
  precondition(r_, shadow_);
  double rho = 1.0;
  double alpha = 1.0;
  double omega = 1.0;
  const FineLevel& fine = preconditioner_.fine();
  p_ = zeros(fine);
  v_ = zeros(fine);
  std::size_t iterations = 0;
  while (iterations < most && std::sqrt(dot(r_, r_)) > norm) {
    const double next = dot(shadow_, r_);
    const double beta = next / rho * (alpha / omega);
    if (!std::isfinite(beta)) {
      break;  // breakdown of the recurrence; the next call starts with a new shadow residual
    }
    rho = next;
    add(p_, -omega, v_);
    for (const std::size_t colour : {kRed, kBlack}) {
      for (std::size_t i = 0; i < p_[colour].size(); ++i) {
        p_[colour][i] = r_[colour][i] + beta * p_[colour][i];
      }
    }
    precondition(p_, p_hat_);
    apply(p_hat_, v_);
    alpha = rho / dot(shadow_, v_);
    if (!std::isfinite(alpha)) {
      break;
    }
    add(r_, -alpha, v_);
    precondition(r_, s_hat_);
    apply(s_hat_, t_);
    const double length = dot(t_, t_);
    omega = length > 0.0 ? dot(t_, r_) / length : 0.0;
    add(u_.u, alpha, p_hat_);
    add(u_.u, omega, s_hat_);
    add(r_, -omega, t_);
    ++iterations;
    if (omega == 0.0) {
      break;
    }
  }
  return iterations;
}

VANTAGE_INLINE Defect MirrorSolver::defect() {
  take_residual();
  Defect defect;
  defect.norm = std::sqrt(dot(r_, r_));
  for (const HalfField<double>& half : r_) {
    defect.largest = std::max(defect.largest, *std::max_element(half.begin(), half.end()));
  }
  u_.at_source = u_.u[source_.colour][source_.brick * kHalfBrick + source_.offset];
  defect.stuck = count_stuck(preconditioner_.fine(), u_);
  return defect;
}

VANTAGE_INLINE std::size_t MirrorSolver::memory_bytes() const {
  return u_.memory_bytes() + 14 * bytes_of(r_[0]) + 12 * bytes_of(weights_[0][0]) + bytes_of(cycle_);
}

}  // namespace vantage::detail
