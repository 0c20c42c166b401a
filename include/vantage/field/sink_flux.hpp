// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vantage/compiler.hpp>
#include <vantage/field/laplace_problem.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Sinks that hang together, and what flows into them.
struct SinkCluster {
  std::vector<VoxelIndex> sinks;  ///< in raster order
  double flux = 0.0;              ///< potential differences over their open faces, summed
};

/// The sinks of the problem in clusters (26 neighbours), clusters by their first cells. Of a harmonic field
/// (NeumannScheme::FiniteVolume) their fluxes add up to source_flux(), but for what a uniform source adds; the share
/// of a cluster is the chance that a random walk from the sensor leaves there first. `phi` is by position in the
/// problem. Throws std::invalid_argument if it is of another size.
[[nodiscard]] std::vector<SinkCluster> sink_clusters(const LaplaceProblem& problem, std::span<const double> phi);

/// What flows out of the source: potential differences over its open faces, summed. Throws as `sink_clusters`.
[[nodiscard]] double source_flux(const LaplaceProblem& problem, std::span<const double> phi);

}  // namespace vantage
