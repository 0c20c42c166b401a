// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Options of LaplaceMultigrid.
struct MultigridOptions {
  NeumannScheme neumann = NeumannScheme::FiniteVolume;  ///< what a closed face contributes
  double tolerance = 1e-8;  ///< stop when the residual is this share of the source, in the Euclidean norm, in (0, 1)
  /// A source spread evenly over all unknowns, in total, as a share of the sensor's own, >= 0. Without it there is no
  /// certificate: phi falls below what a double can tell apart, and is level in dead ends.
  double uniform_source = 1e-4;
  std::size_t max_iterations = 400;  ///< of the Krylov method, in all, > 0
  std::size_t threads = 1;           ///< at most, > 0; never changes a bit of the field

  /// Throws std::invalid_argument naming the option at fault.
  void validate() const;
};

/// Why LaplaceMultigrid stopped.
enum class MultigridStop : std::uint8_t {
  Converged,       ///< the residual is small enough, and the certificate holds if there is a uniform source
  NoSinks,         ///< nothing to solve: phi is 1 everywhere
  IterationLimit,  ///< it is not, after as many iterations as were allowed
  Stalled,         ///< it is not, and the residual does not fall any further
};

[[nodiscard]] constexpr std::string_view to_string(MultigridStop stop) {
  switch (stop) {
    case MultigridStop::Converged:
      return "converged";
    case MultigridStop::NoSinks:
      return "no sinks";
    case MultigridStop::IterationLimit:
      return "iteration limit";
    case MultigridStop::Stalled:
      return "stalled";
  }
  return "";
}

/// What LaplaceMultigrid did.
struct MultigridReport {
  MultigridStop stop = MultigridStop::IterationLimit;  ///< why it ended
  bool certified = false;                              ///< every cell but the sinks has a strictly lower neighbour
  std::size_t stuck_cells = 0;                         ///< cells that have none
  std::size_t unknowns = 0;                            ///< cells of the sensor's component without its sinks
  std::size_t sinks = 0;                               ///< frontier cells of that component
  std::size_t dropped_cells = 0;                       ///< cells of other components
  std::size_t dropped_components = 0;                  ///< how many of those there are
  std::size_t levels = 0;                              ///< of the multigrid hierarchy
  std::size_t iterations = 0;                          ///< of the Krylov method
  std::size_t refinements = 0;                         ///< times the residual was taken in double
  double residual = 0.0;                               ///< as a share of the source, in the Euclidean norm
  double largest_residual =
      0.0;                       ///< the largest of all cells where the field is too low, the sensor's source being 1
  double source_per_cell = 0.0;  ///< the uniform source of one cell, in the same unit: more than that is certain
  std::size_t memory_bytes = 0;  ///< held by the solver, the field included
  double setup_seconds = 0.0;    ///< wall time from the domain to the hierarchy
  double solve_seconds = 0.0;    ///< wall time of the solution, certificate included
};

/// Solves the problem of Shade & Newman 2011, IV (see LaplaceProblem), by conjugate gradients preconditioned with
/// multigrid, in time and memory proportional to the number of cells. (NeumannScheme::Mirror, whose operator is not
/// symmetric, by BiCGSTAB with the same preconditioner, a few times slower.)
///
///     const LaplaceMultigrid field(known_free_domain(map), sensor_cell);
///     if (field.report().certified) ... field.phi(cell) ...
///
/// It solves A u = e_s + eps, A the negative Laplacian with u = 0 at the sinks, e_s a unit source in the sensor's
/// cell and eps the small uniform one, and gives phi = u / u_s: 1 at the sensor, 0 at the sinks, and elsewhere, but
/// for eps, harmonic. As eps > 0, a residual below it proves that every cell has a strictly lower neighbour; the
/// values given are compared to make sure (docs/harmonic.md). Behind the sensor, seen from the sinks, phi rises above
/// 1 by as little.
///
/// The same input gives the same bits on every processor and for any number of threads.
class LaplaceMultigrid {
 public:
  /// Solves on the component of `source`, which must be in the domain and no sink. Throws std::invalid_argument
  /// naming what does not fit.
  LaplaceMultigrid(LaplaceDomain domain, const VoxelIndex& source, const MultigridOptions& options = {});
  /// The same problem, given as a list.
  explicit LaplaceMultigrid(const LaplaceProblem& problem, const MultigridOptions& options = {});
  LaplaceMultigrid(const LaplaceMultigrid&) = delete;
  LaplaceMultigrid& operator=(const LaplaceMultigrid&) = delete;
  /// Moves; what is moved from may only be destroyed or assigned to.
  LaplaceMultigrid(LaplaceMultigrid&&) noexcept;
  /// The same.
  LaplaceMultigrid& operator=(LaplaceMultigrid&&) noexcept;
  ~LaplaceMultigrid();

  /// How it went.
  [[nodiscard]] const MultigridReport& report() const;
  /// The sensor's component, its bricks in raster order.
  [[nodiscard]] const LaplaceDomain& domain() const;
  /// Potential of a cell; none outside the sensor's component.
  [[nodiscard]] std::optional<double> phi(const VoxelIndex& cell) const;
  /// Potential by position in `problem`, whose cells must all be in the sensor's component.
  [[nodiscard]] std::vector<double> values(const LaplaceProblem& problem) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
