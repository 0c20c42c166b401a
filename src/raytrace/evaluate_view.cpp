// SPDX-License-Identifier: MIT
#include <atomic>
#include <bit>
#include <exception>
#include <mutex>
#include <raytrace/view_placer.hpp>
#include <thread>
#include <utility>
#include <vantage/raytrace/evaluate_view.hpp>

#include "map/option_rule.hpp"

namespace vantage {

ViewEvaluation evaluate_view(const RayCaster& caster, const Pose& world_from_sensor, const ViewRays& rays,
                             const VoxelBox& object, CellSet* seen) {
  CellSet cells = caster.visible_cells(world_from_sensor, rays, object);
  const ViewEvaluation evaluation{caster.count(cells, Occupancy::Unknown), caster.count(cells, Occupancy::Occupied)};
  if (seen != nullptr) {
    *seen = std::move(cells);
  }
  return evaluation;
}

std::vector<ViewEvaluation> evaluate_views(const RayCaster& caster, std::span<const Pose> views, const ViewRays& rays,
                                           const VoxelBox& object, std::size_t threads) {
  detail::require_option(threads > 0, "evaluate_views: threads", threads, "> 0");
  std::vector<ViewEvaluation> evaluations(views.size());
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < views.size(); i = next++) {
        evaluations[i] = evaluate_view(caster, views[i], rays, object);
      }
    } catch (...) {
      const std::scoped_lock lock(failing);
      failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min(threads, views.size()); ++i) {
      others.emplace_back(work);
    }
    work();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
  return evaluations;
}

ViewEvaluation UniformRayTracer::evaluate(const Pose& world_from_sensor, const ViewRays& rays, const VoxelBox& object,
                                          CellSet* seen) const {
  const ViewPlacer placer(world_from_sensor, rays, map_->frame());
  const Eigen::Vector3d& origin = world_from_sensor.translation();
  CellSet cells(object);
  ViewEvaluation evaluation;
  RayBlock block;
  for (const RayTile& tile : rays.tiles()) {
    placer.place_ends(tile, block);
    for (std::uint64_t left = tile.rays; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const RayEnd end =
          first_not_free(*map_, map_->frame(), origin, {block.end[0][i], block.end[1][i], block.end[2][i]});
      if (end.occupancy == Occupancy::Free || !object.contains(end.cell) || cells.contains(end.cell) ||
          (map_->frame().centre_of(end.cell) - origin).norm() < rays.min_range_m()) {
        continue;
      }
      cells.insert(end.cell);
      ++(end.occupancy == Occupancy::Occupied ? evaluation.occupied : evaluation.unknown);
    }
  }
  if (seen != nullptr) {
    *seen = std::move(cells);
  }
  return evaluation;
}

}  // namespace vantage
