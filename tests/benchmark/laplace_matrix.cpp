// SPDX-License-Identifier: MIT
#include <benchmark/laplace_matrix.hpp>
#include <vector>

namespace vantage {

LaplaceMatrix matrix_of(const LaplaceDomain& domain, const VoxelIndex& source) {
  const LaplaceProblem problem(domain, source);
  std::vector<int> number(problem.size(), -1);
  int size = 0;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (problem.kind(static_cast<LaplaceProblem::Position>(i)) != LaplaceCell::Sink) {
      number[i] = size++;
    }
  }
  LaplaceMatrix system;
  system.matrix.resize(size, size);
  system.matrix.reserve(Eigen::VectorXi::Constant(size, 7));
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (number[i] < 0) {
      continue;
    }
    double diagonal = 0.0;
    for (const LaplaceProblem::Position neighbour : problem.neighbours(static_cast<LaplaceProblem::Position>(i))) {
      if (neighbour == LaplaceProblem::kClosed) {
        continue;
      }
      diagonal += 1.0;
      if (const int other = number[static_cast<std::size_t>(neighbour)]; other >= 0) {
        system.matrix.insert(other, number[i]) = -1.0;
      }
    }
    system.matrix.insert(number[i], number[i]) = diagonal;
  }
  system.matrix.makeCompressed();
  system.right = Eigen::VectorXd::Zero(size);
  system.right(number[static_cast<std::size_t>(problem.source())]) = 1.0;
  return system;
}

}  // namespace vantage
