// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/laplace_matrix.hpp>
#include <memory>

namespace vantage {

/// Conjugate gradients with BoomerAMG of HYPRE as preconditioner, with the settings that its manual recommends for
/// three dimensions.
class BoomerAmg {
 public:
  explicit BoomerAmg(const LaplaceMatrix& system);
  BoomerAmg(const BoomerAmg&) = delete;
  BoomerAmg& operator=(const BoomerAmg&) = delete;
  ~BoomerAmg();

  /// Setup and solution, from zero, up to this relative residual. Returns the number of iterations.
  int solve(double tolerance);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
