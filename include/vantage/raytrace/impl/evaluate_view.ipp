// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <utility>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/raytrace/impl/view_placer.hpp>

#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/raytrace/impl/shared_work.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

// The part of a box that rays from this pose can reach. A set of its cells may be much smaller.
inline VoxelBox in_range(const VoxelBox& box, const RayCaster& caster, const Pose& world_from_sensor,
                         const ViewRays& rays) {
  const Eigen::Vector3d from = world_from_sensor.translation();
  const Eigen::Vector3d range = Eigen::Vector3d::Constant(rays.max_range_m() + caster.frame().size_m);
  return detail::box_overlap(box, {caster.frame().cell_of(from - range), caster.frame().cell_of(from + range)});
}

}  // namespace detail

VANTAGE_INLINE ViewEvaluation evaluate_view(const RayCaster& caster, const Pose& world_from_sensor,
                                            const ViewRays& rays, const VoxelBox& object, CellSet* seen) {
  CellSet cells = caster.visible_cells(
      world_from_sensor, rays, seen != nullptr ? object : detail::in_range(object, caster, world_from_sensor, rays));
  const ViewEvaluation evaluation{caster.count(cells, Occupancy::Unknown), caster.count(cells, Occupancy::Occupied)};
  if (seen != nullptr) {
    *seen = std::move(cells);
  }
  return evaluation;
}

VANTAGE_INLINE std::vector<ViewEvaluation> evaluate_views(const RayCaster& caster, std::span<const Pose> views,
                                                          const ViewRays& rays, const VoxelBox& object,
                                                          std::size_t threads) {
  detail::require_option(threads > 0, "evaluate_views: threads", threads, "> 0");
  std::vector<ViewEvaluation> evaluations(views.size());
  detail::share_work(views.size(), threads,
                     [&](std::size_t i) { evaluations[i] = evaluate_view(caster, views[i], rays, object); });
  return evaluations;
}

// Cell by cell along every ray. A cell counts once, however many rays end in it.
VANTAGE_INLINE ViewEvaluation UniformRayTracer::evaluate(const Pose& world_from_sensor, const ViewRays& rays,
                                                         const VoxelBox& object, CellSet* seen) const {
  const detail::RayPlacer placer = detail::view_placer(world_from_sensor, rays, map_->frame());
  const Eigen::Vector3d& origin = world_from_sensor.translation();
  CellSet cells(object);
  ViewEvaluation evaluation;
  detail::RayBlock block;
  for (const RayTile& tile : rays.tiles()) {
    placer.place_ends(tile.directions, tile.stretch, block);
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
