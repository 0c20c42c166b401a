// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/field/laplace_domain.hpp>

#include <vantage/field/impl/brick_solver.hpp>
#include <vantage/field/impl/refinement.hpp>

namespace vantage::detail {

/// Solver for NeumannScheme::Mirror: the value behind a closed face equals that of the opposite neighbour. The
/// operator is not symmetric, so it is solved by BiCGSTAB in double precision. The preconditioner is the multigrid
/// cycle of the symmetric operator, which differs only at walls. (Shade & Newman 2011, eq. 9; van der Vorst 1992.)
class MirrorSolver {
 public:
  MirrorSolver(const LaplaceDomain& domain, BrickSolver& preconditioner, const CellPlace& source, double uniform);

  /// Continues until the residual is at most `norm`, after `most` iterations, or when BiCGSTAB breaks down. Returns
  /// the number of iterations.
  std::size_t solve(double norm, std::size_t most);
  /// Recomputes the residual and counts the stuck cells.
  [[nodiscard]] Defect defect();
  /// Moves the solution out.
  [[nodiscard]] CellValues take() { return std::move(u_); }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  using Field = std::array<HalfField<double>, 2>;

  void apply(const Field& in, Field& out) const;
  void precondition(const Field& in, Field& out);
  void take_residual();

  BrickSolver& preconditioner_;
  CellPlace source_;
  double uniform_;
  /// Per colour, side and row, four bits per cell: the weight of the neighbour, 0 for a closed face.
  std::array<std::array<AlignedVector<std::uint32_t>, 6>, 2> weights_;
  HalfField<float> cycle_;
  CellValues u_;
  Field r_, shadow_, p_, v_, t_, p_hat_, s_hat_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/mirror_solver.ipp>
#endif
