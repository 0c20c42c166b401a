// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How a closed face enters the difference equation of its cell.
enum class NeumannScheme : std::uint8_t {
  FiniteVolume,  ///< the face drops out: what flows into a cell flows out of it, and the operator is symmetric
  Mirror,        ///< the value behind the face mirrors the one opposite (Shade & Newman 2011, eq. 9): not symmetric
};

/// In which order a sweep visits the cells.
enum class SweepOrder : std::uint8_t {
  Lexicographic,  ///< z, then y, then x
  RedBlack,       ///< all cells of even x + y + z, then all odd ones: updates within a colour are independent
};

/// Options of LaplaceRelaxation; the defaults are the paper's method.
struct RelaxationOptions {
  NeumannScheme neumann = NeumannScheme::FiniteVolume;  ///< what a closed face contributes
  SweepOrder order = SweepOrder::Lexicographic;         ///< in which order the cells are visited
  double tolerance = 1e-4;          ///< stop when the largest relative change of a sweep is below it (eq. 10), > 0
  std::size_t max_sweeps = 100000;  ///< give up after so many, > 0
  double over_relaxation = 1.0;     ///< in (0, 2); 1 is Gauss-Seidel, more goes further (SOR)
  /// A source spread evenly over the interior cells, in total, >= 0; 0 is Laplace's equation as in the paper. With it
  /// every cell that nearly solves its equation has a strictly lower neighbour, where phi would else be level.
  double uniform_source = 0.0;

  /// Throws std::invalid_argument naming the option at fault.
  void validate() const;
};

/// Why a solver stopped.
enum class LaplaceStop : std::uint8_t { Converged, SweepLimit };

[[nodiscard]] constexpr std::string_view to_string(LaplaceStop stop) {
  return stop == LaplaceStop::Converged ? "converged" : "sweep limit";
}

/// What a solver did.
struct LaplaceReport {
  LaplaceStop stop = LaplaceStop::SweepLimit;  ///< why it ended
  std::size_t sweeps = 0;                      ///< passes over all cells
  double last_change = 0.0;                    ///< largest relative change in the last sweep (eq. 10)
  std::uint64_t cell_updates = 0;              ///< cells computed anew, over all sweeps
  double seconds = 0.0;                        ///< wall time
};

/// The field and how it was found.
struct LaplaceSolution {
  std::vector<double> phi;  ///< by position in the problem
  LaplaceReport report;     ///< how the solution came about
};

/// The finite difference relaxation of Shade & Newman 2011, IV-C: each interior cell in turn takes the mean of its
/// neighbours (eq. 8), the latest values used as soon as they are there (Gauss-Seidel).
///
/// The stop rule of the paper (eq. 10) bounds the change of a sweep, not the error, and it leaves cells without a
/// lower neighbour: check what you follow (streamline.hpp). Starting from zero or from the same guess gives the same
/// bits.
class LaplaceRelaxation {
 public:
  /// Keeps a reference to `problem`. Throws std::invalid_argument naming the option at fault.
  explicit LaplaceRelaxation(const LaplaceProblem& problem, const RelaxationOptions& options = {});

  /// Starts from `phi` (by position) instead of zero; values at sinks and source are replaced by 0 and 1. Throws
  /// std::invalid_argument unless there is one finite value per cell.
  void start_from(std::span<const double> phi);
  /// Visits every interior cell once; returns the largest relative change (eq. 10).
  double sweep();
  /// Sweeps until a rule stops it.
  void run();
  /// Sweeps `count` more times, whatever the changes.
  void run(std::size_t count);

  /// By position in the problem.
  [[nodiscard]] std::span<const double> phi() const { return {values_.data(), problem_->size()}; }
  /// How the solution came about.
  [[nodiscard]] const LaplaceReport& report() const { return report_; }
  /// Largest |mean of the neighbours - phi| over the interior cells: 0 where the equations hold exactly.
  [[nodiscard]] double largest_defect() const;

 private:
  struct Row {  // phi[self] = weight * (sum of phi[neighbours] + source)
    std::array<LaplaceProblem::Position, 6> neighbours;
    LaplaceProblem::Position self;
    double weight;
  };
  [[nodiscard]] Row row_of(LaplaceProblem::Position position) const;
  [[nodiscard]] double mean_of(const Row& row) const;

  const LaplaceProblem* problem_;
  RelaxationOptions options_;
  double source_per_cell_ = 0.0;
  std::vector<Row> rows_;       // the interior cells in sweep order
  std::vector<double> values_;  // one more than there are cells: the last is 0 and stands behind closed faces
  LaplaceReport report_;
};

/// One-shot use: relax from `start` (zero if empty).
[[nodiscard]] LaplaceSolution relax_laplace(const LaplaceProblem& problem, const RelaxationOptions& options = {},
                                            std::span<const double> start = {});

}  // namespace vantage
