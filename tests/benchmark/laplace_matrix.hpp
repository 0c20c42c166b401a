// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>

namespace vantage {

/// The system that LaplaceMultigrid solves, as a matrix for general solvers: the negative Laplacian over the cells of
/// the source's component that are no sinks, and a unit source.
struct LaplaceMatrix {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd right;
};

[[nodiscard]] LaplaceMatrix matrix_of(const LaplaceDomain& domain, const VoxelIndex& source);
/// The domain as a list.
[[nodiscard]] LaplaceProblem problem_of(const LaplaceDomain& domain, const VoxelIndex& source);

}  // namespace vantage
