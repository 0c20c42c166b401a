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
  options.measure_coverage = !request.no_coverage;
  return options;
}

ObjectRunPlanner object_run_planner(const ExploreRequest& request, const PlannerSetup& setup,
                                    const ObjectScene& scene, const ExplorationRun& run,
                                    const std::vector<SurfaceSample>& samples, const Settings& settings) {
  constexpr const char* kOurs = "next-best-view";
  const auto peers = object_peer_names();
  if (request.planner == kOurs) {
    return {make_planner(kOurs, setup, settings), std::nullopt};
  }
  if (std::find(peers.begin(), peers.end(), request.planner) == peers.end()) {
    std::string names = kOurs;
    for (const std::string_view peer : peers) {
      names += ", " + std::string(peer);
    }
    throw std::invalid_argument("no planner '" + request.planner + "' looks at an object; there are: " + names);
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
