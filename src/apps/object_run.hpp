// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/object_scene.hpp>
#include <vantage/sim/seen_surface.hpp>
#include <vector>

#include "apps/explore_request.hpp"

// A run around an object, as the commands reconstruct and evaluate make it.
namespace vantage::apps {

/// What every run around an object has: a scan at each goal, the box of the object unknown at first, and samples of
/// its surface.
[[nodiscard]] ExplorationRunOptions object_run_options(const ExploreRequest& request, const ObjectScene& scene,
                                                       const TriangleMesh& object);

/// A planner of views, and the view it would start with; none: it starts anywhere.
struct ObjectRunPlanner {
  std::unique_ptr<ExplorationPlanner> planner;
  std::optional<Pose> first_view;
};

/// Makes the planner that the request names, with `settings`, or the peer of that name (make_object_peer), which
/// takes no settings. `scene` and `run` must outlive it. `samples` are points of the object's surface. Throws
/// std::invalid_argument if there is no such planner or a setting is wrong.
[[nodiscard]] ObjectRunPlanner object_run_planner(const ExploreRequest& request, const PlannerSetup& setup,
                                                  const ObjectScene& scene, const ExplorationRun& run,
                                                  const std::vector<SurfaceSample>& samples,
                                                  const Settings& settings);

}  // namespace vantage::apps
