// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How a closed face enters the difference equation of its cell.
enum class NeumannScheme : std::uint8_t {
  FiniteVolume,  ///< the face is left out, so the flow is conserved and the operator is symmetric
  /// the value behind the face equals that of the opposite neighbour; not symmetric (Shade & Newman 2011, eq. 9)
  Mirror,
};

/// Options of LaplaceRelaxation. The defaults give the paper's method, except for the Neumann scheme.
struct RelaxationOptions {
  NeumannScheme neumann = NeumannScheme::FiniteVolume;  ///< boundary condition at closed faces
  double tolerance = 1e-4;          ///< stop when the largest relative change in a sweep is below this (eq. 10), > 0
  std::size_t max_sweeps = 100000;  ///< limit on the number of sweeps, > 0
  /// Total of an extra source, distributed evenly over the interior cells, >= 0; the paper's Laplace equation has 0.
  /// With an extra source, every cell that nearly solves its equation has a strictly lower neighbour, even where phi
  /// would otherwise be constant.
  double uniform_source = 0.0;

  /// Throws std::invalid_argument, which names the invalid option.
  void validate() const;
};

/// Why the solver has stopped.
enum class LaplaceStop : std::uint8_t { Converged, SweepLimit };

[[nodiscard]] constexpr std::string_view to_string(LaplaceStop stop) {
  return stop == LaplaceStop::Converged ? "converged" : "sweep limit";
}

/// Statistics of the solver.
struct LaplaceReport {
  LaplaceStop stop = LaplaceStop::SweepLimit;  ///< why it has stopped
  std::size_t sweeps = 0;                      ///< number of sweeps
  double last_change = 0.0;                    ///< largest relative change in the last sweep (eq. 10)
  std::uint64_t cell_updates = 0;              ///< total number of cell updates
};

/// The field and the statistics of its solution.
struct LaplaceSolution {
  std::vector<double> phi;  ///< potential by position in the problem
  LaplaceReport report;     ///< statistics
};

/// Finite difference relaxation (Gauss-Seidel): sets each interior cell in turn to the mean of its neighbours (eq.
/// 8), using new values immediately. It is the paper's solver and the reference for LaplaceMultigrid.
///
/// The stopping rule (eq. 10) limits the change per sweep and not the error, and it may leave cells without a lower
/// neighbour. Check the field before you follow it (streamline.hpp). A run from the same start always gives the same
/// bits. (Shade & Newman 2011, IV-C.)
class LaplaceRelaxation {
 public:
  /// Keeps a reference to `problem`. Throws std::invalid_argument, which names the invalid option.
  explicit LaplaceRelaxation(const LaplaceProblem& problem, const RelaxationOptions& options = {});

  /// Visits every interior cell once, in the order z, then y, then x. Returns the largest relative change (eq. 10).
  double sweep();
  /// Sweeps until it has converged or reached `max_sweeps`.
  void run();
  /// Sweeps `count` more times, without a stopping rule.
  void run(std::size_t count);

  /// The potential, by position in the problem.
  [[nodiscard]] std::span<const double> phi() const { return {values_.data(), problem_->size()}; }
  /// Statistics of the sweeps so far.
  [[nodiscard]] const LaplaceReport& report() const { return report_; }

 private:
  struct Row {  // equation of a cell: phi[self] = weight * (sum of phi[neighbours] + source)
    std::array<LaplaceProblem::Position, 6> neighbours;
    LaplaceProblem::Position self;
    double weight;
  };
  [[nodiscard]] Row row_of(LaplaceProblem::Position position) const;
  [[nodiscard]] double mean_of(const Row& row) const;

  const LaplaceProblem* problem_;
  RelaxationOptions options_;
  double source_per_cell_ = 0.0;
  std::vector<Row> rows_;       // the interior cells, in sweep order
  std::vector<double> values_;  // one value more than cells: the last is 0 and stands for closed faces
  LaplaceReport report_;
};

/// Runs a LaplaceRelaxation until it stops and returns its field. Errors as LaplaceRelaxation.
[[nodiscard]] LaplaceSolution relax_laplace(const LaplaceProblem& problem, const RelaxationOptions& options = {});

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/laplace_relaxation.ipp>
#endif
