// SPDX-License-Identifier: MIT
#include "apps/object_run.hpp"

#include <algorithm>
#include <utility>
#include <vantage/evaluation/object_peers.hpp>

namespace vantage::apps {

ExplorationRunOptions object_run_options(const ExploreRequest& request, const ObjectScene& scene,
                                         const TriangleMesh& object) {
  ExplorationRunOptions options;
  options.map.resolution_m = request.resolution_m;
  options.map.max_bytes = max_bytes_of(request.memory_limit_mb);
  options.max_views = request.max_views;
  options.scan_spacing_m = 0.0;
  options.seed = request.seed;
  options.noise = noise_of(request);
  options.unknown_box = scene.box;
  options.object_surface = sample_surface(object);
  return options;
}

ObjectRunPlanner object_run_planner(const ExploreRequest& request, const PlannerSetup& setup,
                                    const ObjectScene& scene, const ExplorationRun& run,
                                    const std::vector<SurfaceSample>& samples, const Settings& settings) {
  const auto peers = object_peer_names();
  if (std::find(peers.begin(), peers.end(), request.planner) == peers.end()) {
    return {make_planner(request.planner, setup, settings), std::nullopt};
  }
  const SeenSurface surface(TriangleScene(scene.world.mesh), samples, setup.sensor);
  auto peer = make_object_peer(request.planner, {.platform = setup.platform,
                                                 .scene = &scene,
                                                 .truth = &run.truth(),
                                                 .surface = &surface,
                                                 .views = request.max_views,
                                                 .seed = request.seed});
  const std::optional<Pose> first = peer->first_view();
  return {std::move(peer), first};
}

}  // namespace vantage::apps
