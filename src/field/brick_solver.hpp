// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "field/coarse_correction.hpp"
#include "field/fine_kernels.hpp"

namespace vantage::detail {

/// Conjugate gradients in float on the black cells, the red ones solved for (Schur complement), with one multigrid
/// cycle as preconditioner: a relaxation of the black cells before the correction of the coarser levels and one after
/// it.
class BrickSolver {
 public:
  explicit BrickSolver(FineLevel fine);

  [[nodiscard]] const FineLevel& fine() const { return fine_; }
  [[nodiscard]] std::size_t level_count() const { return 1 + coarse_.level_count(); }
  /// The right hand side, to be written before `solve`; overwritten by the residual.
  [[nodiscard]] HalfField<float>& right() { return r_; }
  /// Starts from zero, until the residual has fallen by `reduction` or `most` iterations are done; returns their
  /// number.
  std::size_t solve(double reduction, std::size_t most);
  /// What `solve` found.
  [[nodiscard]] const HalfField<float>& solution() const { return x_; }
  /// `out = one preconditioning of right()`: symmetric and positive definite.
  void precondition(HalfField<float>& out);
  /// `out = S in`, the operator of the black cells.
  void apply(const HalfField<float>& in, HalfField<float>& out);

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  template <class First>
  double way_down(const First& first);
  double begin();
  double advance(float step);
  double correct();
  double turn(float share);
  [[nodiscard]] double total() const;

  FineLevel fine_;
  CoarseCorrection coarse_;
  HalfField<float> x_, r_, z_, p_, q_;  // black
  HalfField<float> red_;
  std::vector<double> sums_;  // one per brick, added in their order
};

}  // namespace vantage::detail
