// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>

namespace vantage {

/// The linear system of LaplaceMultigrid as a sparse matrix for general solvers: the negative Laplacian over the
/// non-sink cells of the source's component, and a unit source.
struct LaplaceMatrix {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd right;
};

[[nodiscard]] LaplaceMatrix matrix_of(const LaplaceDomain& domain, const VoxelIndex& source);

}  // namespace vantage
