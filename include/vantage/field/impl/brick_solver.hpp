// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <vantage/field/impl/coarse_correction.hpp>
#include <vantage/field/impl/fine_kernels.hpp>

namespace vantage::detail {

/// Conjugate gradients in single precision on the black cells; the red cells are eliminated (Schur complement). The
/// preconditioner is one multigrid cycle with one relaxation of the black cells before and one after the coarse
/// correction.
class BrickSolver {
 public:
  explicit BrickSolver(FineLevel fine);

  [[nodiscard]] const FineLevel& fine() const { return fine_; }
  [[nodiscard]] std::size_t level_count() const { return 1 + coarse_.level_count(); }
  /// The right hand side: write it before `solve`, which overwrites it with the residual.
  [[nodiscard]] HalfField<float>& right() { return r_; }
  /// Solves from zero until the residual has decreased by the factor `reduction`, or after `most` iterations. Returns
  /// the number of iterations.
  std::size_t solve(double reduction, std::size_t most);
  /// The solution of the last `solve`.
  [[nodiscard]] const HalfField<float>& solution() const { return x_; }
  /// Applies the preconditioner once to right(). It is symmetric and positive definite.
  void precondition(HalfField<float>& out);
  /// out = S in, where S is the operator of the black cells.
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
  HalfField<float> x_, r_, z_, p_, q_;  // fields of the black cells
  HalfField<float> red_;
  std::vector<double> sums_;  // one per brick, always added in the same order
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/brick_solver.ipp>
#endif
