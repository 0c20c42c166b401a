// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/laplace_matrix.hpp>
#include <memory>

namespace vantage {

/// HYPRE's BoomerAMG as preconditioner of its conjugate gradients, with the settings its manual advises for problems
/// in three dimensions.
class BoomerAmg {
 public:
  explicit BoomerAmg(const LaplaceMatrix& system);
  BoomerAmg(const BoomerAmg&) = delete;
  BoomerAmg& operator=(const BoomerAmg&) = delete;
  ~BoomerAmg();

  /// Setup and solution from zero to a relative residual; returns the number of iterations.
  int solve(double tolerance);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
