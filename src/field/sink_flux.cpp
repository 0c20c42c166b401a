// SPDX-License-Identifier: MIT
#include <stdexcept>
#include <utility>
#include <vantage/field/sink_flux.hpp>
#include <vantage/geometry/voxel_clusters.hpp>

namespace vantage {
namespace {

using Position = LaplaceProblem::Position;

void require_values(const LaplaceProblem& problem, std::span<const double> phi) {
  if (phi.size() != problem.size()) {
    throw std::invalid_argument("the flux of a field: phi must have one value for every cell of the problem");
  }
}

// What flows out of a cell; into it, if negative.
double outflow(const LaplaceProblem& problem, std::span<const double> phi, Position from) {
  double sum = 0.0;
  for (const Position neighbour : problem.neighbours(from)) {
    if (neighbour != LaplaceProblem::kClosed) {
      sum += phi[static_cast<std::size_t>(from)] - phi[static_cast<std::size_t>(neighbour)];
    }
  }
  return sum;
}

}  // namespace

std::vector<SinkCluster> sink_clusters(const LaplaceProblem& problem, std::span<const double> phi) {
  require_values(problem, phi);
  std::vector<VoxelIndex> sinks;
  sinks.reserve(problem.sink_count());
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (problem.kind(static_cast<Position>(i)) == LaplaceCell::Sink) {
      sinks.push_back(problem.cells()[i]);
    }
  }
  std::vector<SinkCluster> clusters;
  for (std::vector<VoxelIndex>& cells : voxel_clusters(std::move(sinks))) {
    SinkCluster cluster{std::move(cells)};
    for (const VoxelIndex& sink : cluster.sinks) {
      cluster.flux -= outflow(problem, phi, *problem.position_of(sink));
    }
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

double source_flux(const LaplaceProblem& problem, std::span<const double> phi) {
  require_values(problem, phi);
  return outflow(problem, phi, problem.source());
}

}  // namespace vantage
