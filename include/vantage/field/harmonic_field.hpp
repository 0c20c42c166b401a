// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/field/potential.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How a harmonic field is solved.
enum class FieldSolver : std::uint8_t {
  /// Multigrid, to a small residual. It certifies that descent from every cell ends at a sink.
  Multigrid,
  /// The method of the paper: relaxation from zero until the largest relative change is small (eq. 10). It
  /// continues until descent from the source reaches a sink, or `max_sweeps` are done.
  GaussSeidel,
};

/// Solver, boundary condition and stopping rule of HarmonicField::solve.
struct HarmonicFieldOptions {
  FieldSolver solver = FieldSolver::Multigrid;          ///< the linear solver
  NeumannScheme neumann = NeumannScheme::FiniteVolume;  ///< scheme at closed faces; Mirror (eq. 9) needs GaussSeidel
  double tolerance = 1e-4;         ///< GaussSeidel: largest relative change of the last sweep, in [1e-15, 1] (eq. 10)
  std::size_t max_sweeps = 50000;  ///< GaussSeidel: maximum number of sweeps per field, in [1, 1e7]
  double uniform_source = 1e-4;    ///< see RelaxationOptions; 0: the field of the paper
};

/// A field that leads from a source to sinks: 1 at the source, 0 at the sinks, no flow through the rest of the
/// boundary. (Shade & Newman 2011, eq. 3 to 10.)
struct HarmonicField {
  Potential potential;                      ///< the solution: domain, sinks, source and values
  std::vector<Eigen::Vector3d> streamline;  ///< from the sensor to the chosen sink, metres, world
  std::size_t sweeps = 0;                   ///< sweeps of the solver, or its iterations
  std::uint64_t cell_updates = 0;           ///< updates of cells in these sweeps
  /// Cells without a strictly lower neighbour. 0: descent from every cell ends at a sink.
  std::size_t stuck_cells = 0;
  /// False: the field is not certified (Multigrid), or descent from the source does not reach a sink (GaussSeidel).
  bool followed = true;

  /// Solves on the component of `source` in `domain`, which holds the sinks. The result does not depend on `threads`.
  /// Throws std::invalid_argument if an option is invalid, or if `source` is not in the domain or is a sink.
  [[nodiscard]] static HarmonicField solve(LaplaceDomain domain, const VoxelIndex& source,
                                           const HarmonicFieldOptions& options, std::size_t threads);
  /// Follows the field from `position` (metres, world), or from the centre of the source if it lies in another
  /// cell. Fills in `streamline`, by cells of steepest descent where there is no smooth one. Returns the cells of
  /// the path.
  std::vector<VoxelIndex> follow(const VoxelFrame& frame, const Eigen::Vector3d& position);
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/field/impl/harmonic_field.ipp>
#endif
