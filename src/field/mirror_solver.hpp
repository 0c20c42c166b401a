// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/field/laplace_domain.hpp>

#include "field/brick_solver.hpp"
#include "field/refinement.hpp"

namespace vantage::detail {

/// Shade & Newman's own scheme (2011, eq. 9): behind a closed face lies the value of the cell opposite. Its operator
/// is not symmetric, so it is solved by BiCGSTAB (van der Vorst 1992) in double, preconditioned with the multigrid
/// cycle of the symmetric operator, from which it differs only beside walls.
class MirrorSolver {
 public:
  MirrorSolver(const LaplaceDomain& domain, BrickSolver& preconditioner, const CellPlace& source, double uniform);

  /// Goes on from where it is, until the residual is at most `norm`, or `most` iterations are done, or the residual
  /// does not get any smaller; returns how many it did.
  std::size_t solve(double norm, std::size_t most);
  /// How good the solution is.
  [[nodiscard]] Defect defect();
  /// The solution, which is no longer here after it.
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
  /// For each row by colour and side, four bits per cell: 0 for a closed face, else what its neighbour counts.
  std::array<std::array<AlignedVector<std::uint32_t>, 6>, 2> weights_;
  HalfField<float> cycle_;
  CellValues u_;
  Field r_, shadow_, p_, v_, t_, p_hat_, s_hat_;
};

}  // namespace vantage::detail
