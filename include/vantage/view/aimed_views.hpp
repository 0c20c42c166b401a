// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A side of a cell that blocks sight, to be seen from the adjacent cell.
struct CellSide {
  VoxelIndex cell;    ///< the cell that blocks sight
  VoxelIndex normal;  ///< step from the cell across a face, an edge or a corner, one of kAllNeighbours
};

/// Number and distances of the views that aimed_views draws.
struct AimedViewOptions {
  std::size_t count = 0;        ///< number of random draws of a face; each draw gives at most one view
  double min_distance_m = 0.5;  ///< smallest distance from a view to its face, metres, > 0
  double max_distance_m = 1.5;  ///< largest distance from a view to its face, metres, >= min_distance_m
};

/// Throws std::invalid_argument, which names the invalid option.
void validate(const AimedViewOptions& options);

/// Samples views aimed at unknown space. Each view looks at the centre of a face between an unknown cell of `sought`
/// and a free cell, from a position with a free line of sight to it. Such views look into concavities that views of
/// the whole object may miss.
///
/// Faces are drawn uniformly, with replacement. For each face up to 64 positions are tried, more often near the
/// normal of the face than at grazing angles (Lambert's cosine law). A face for which all positions fail gives no
/// view. Equal seeds and maps give equal views. Poses are world_from_sensor. `caster` must have level 0. Throws
/// std::invalid_argument as `validate`, and if a position is not addressable.
[[nodiscard]] std::vector<Pose> aimed_views(const RayCaster& caster, const CellSet& sought,
                                            const AimedViewOptions& options, std::uint64_t seed);
/// Samples views aimed at given sides of cells, across edges and corners too. Otherwise as above.
[[nodiscard]] std::vector<Pose> aimed_views(const RayCaster& caster, std::span<const CellSide> sides,
                                            const AimedViewOptions& options, std::uint64_t seed);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/aimed_views.ipp>
#endif
