// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vantage/sim/exploration_run.hpp>
#include <vector>

#include "sim/surface_coverage.hpp"

namespace vantage {

/// How far a run has come.
struct ExplorationRun::Progress {
  Progress(const Pose& start, SimulatedSensor simulated, SurfaceCoverage covered, SeenSurface shown)
      : sensor(std::move(simulated)),
        pose(start),
        passed{start.translation()},
        surface(std::move(covered)),
        seen(std::move(shown)) {}

  SimulatedSensor sensor;
  Pose pose;
  double body_radius_m = 0.0;
  double path_length_m = 0.0;
  double since_scan_m = 0.0;
  std::optional<double> time_s;         // of a run that is timed
  Plan plan;                            // the latest
  std::vector<Eigen::Vector3d> passed;  // since the scan before
  std::vector<VoxelIndex> observable;
  SurfaceCoverage surface;
  SeenSurface seen;
  RunRecord record;
};

}  // namespace vantage
