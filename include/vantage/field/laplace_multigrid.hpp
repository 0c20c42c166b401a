// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/field/potential.hpp>
#include <vantage/geometry/voxel.hpp>

namespace VANTAGE_EXPORT vantage {

/// Stopping rule, extra source and threads of LaplaceMultigrid.
struct MultigridOptions {
  double tolerance = 1e-8;  ///< stop when the residual is below this share of the source (Euclidean norm), in (0, 1)
  /// A small extra source, distributed evenly over all unknowns: its total as a share of the source at the sensor, >=
  /// 0. Without it the field has no certificate: in dead ends, phi is constant or its differences vanish in double
  /// precision.
  double uniform_source = 1e-4;
  std::size_t max_iterations = 400;  ///< total number of Krylov iterations, > 0
  std::size_t threads = 1;           ///< maximum number of threads, > 0; the field is bitwise independent of it

  /// Throws std::invalid_argument, which names the invalid option.
  void validate() const;
};

/// Why LaplaceMultigrid has stopped.
enum class MultigridStop : std::uint8_t {
  Converged,       ///< the residual is small enough; with a uniform source, the certificate holds too
  NoSinks,         ///< there is no sink, so phi is 1 everywhere
  IterationLimit,  ///< not converged within the allowed iterations
  Stalled,         ///< not converged, and the residual no longer decreases
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

/// How a solution by LaplaceMultigrid ended: stop, certificate, sizes and times.
struct MultigridReport {
  MultigridStop stop = MultigridStop::IterationLimit;  ///< why the solver has stopped
  bool certified = false;                              ///< every cell except the sinks has a strictly lower neighbour
  std::size_t stuck_cells = 0;                         ///< number of cells without one, sinks excluded
  std::size_t unknowns = 0;                            ///< cells of the sensor's component, without sinks
  std::size_t sinks = 0;                               ///< sinks of that component
  std::size_t dropped_cells = 0;                       ///< cells of other components
  std::size_t dropped_components = 0;                  ///< number of other components
  std::size_t levels = 0;                              ///< levels of the multigrid hierarchy
  std::size_t iterations = 0;                          ///< Krylov iterations
  std::size_t refinements = 0;  ///< number of times the residual was recomputed in double precision
  double residual = 0.0;        ///< residual divided by the source, Euclidean norm
  double largest_residual =
      0.0;  ///< largest residual of a cell where the field is too low; the source at the sensor is 1
  /// uniform source of one cell, in the same unit; a smaller largest_residual proves the certificate
  double source_per_cell = 0.0;
  std::size_t memory_bytes = 0;  ///< memory of the solver, the field included, bytes
  double setup_seconds = 0.0;    ///< wall time to build the hierarchy
  double solve_seconds = 0.0;    ///< wall time of the solution, certificate included
};

/// Solves the Laplace problem of Shade & Newman 2011, IV (see LaplaceProblem) with conjugate gradients and a
/// multigrid preconditioner. Time and memory are linear in the number of cells. A closed face drops out of the
/// equation of its cell (NeumannScheme::FiniteVolume).
///
///     const LaplaceMultigrid field(known_free_domain(map), sensor_cell);
///     if (field.report().certified) ... field.phi(cell) ...
///
/// Idea: solve A u = e_s + eps, where A is the negative Laplacian with u = 0 at the sinks, e_s a unit source in the
/// sensor's cell, and eps a small uniform source. Then phi = u / u_s is 1 at the sensor, 0 at the sinks, and, apart
/// from eps, harmonic elsewhere. Because eps > 0, a residual below eps proves that every cell has a strictly lower
/// neighbour, so steepest descent from every cell ends at a sink. The returned values are checked for this as well
/// (docs/harmonic.md). As a side effect of eps, phi slightly exceeds 1 in cells behind the sensor, away from the
/// sinks.
///
/// The result is bitwise the same on every processor and for any number of threads.
class LaplaceMultigrid {
 public:
  /// Solves on the component of `source`. Throws std::invalid_argument if an option is invalid, or if `source` is not
  /// in the domain or is a sink.
  LaplaceMultigrid(LaplaceDomain domain, const VoxelIndex& source, const MultigridOptions& options = {});
  /// Solves a problem given as a list of cells. Throws std::invalid_argument if an option is invalid.
  explicit LaplaceMultigrid(const LaplaceProblem& problem, const MultigridOptions& options = {});

  /// Statistics of the solution.
  [[nodiscard]] const MultigridReport& report() const { return report_; }
  /// The solution. Its domain is the component of the source; bricks in raster order.
  [[nodiscard]] const Potential& potential() const { return potential_; }
  /// Moves the solution out.
  [[nodiscard]] Potential take() && { return std::move(potential_); }
  /// Potential of a cell; nullopt outside the component of the source.
  [[nodiscard]] std::optional<double> phi(const VoxelIndex& cell) const { return potential_.at(cell); }

 private:
  MultigridReport report_;
  Potential potential_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/laplace_multigrid.ipp>
#endif
