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

/// A face of a cell that stops sight, seen from the cell across it.
struct CellFace {
  VoxelIndex cell;    ///< which stops sight
  VoxelIndex normal;  ///< one of kFaceNeighbours: the step across the face
};

/// Options of aimed_views.
struct AimedViewOptions {
  std::size_t count = 0;        ///< how many faces are drawn to be looked at, each by at most one view
  double min_distance_m = 0.5;  ///< from a view to the face that it looks at, metres, > 0
  double max_distance_m = 1.5;  ///< the same, >= min_distance_m
};

/// Throws std::invalid_argument naming the option at fault.
void validate(const AimedViewOptions& options);

/// Views aimed at what is still unknown: each looks at the middle of a face of one of the `sought` cells, unknown,
/// across which there is a free cell, from a place that sees it: the line of sight runs along free cells alone. So
/// they look into folds that no view of the whole object happens to look into.
///
/// The faces are drawn evenly from all there are. For each, places are drawn, towards the normal of the face more
/// often than along it (Lambert's cosine law), until one sees it; a face that none of 64 sees has no view. The same
/// seed and map give the same views. `caster` must look at the finest cells. Errors as `validate`.
[[nodiscard]] std::vector<Pose> aimed_views(const RayCaster& caster, const CellSet& sought,
                                            const AimedViewOptions& options, std::uint64_t seed);
/// The same, of faces that are given.
[[nodiscard]] std::vector<Pose> aimed_views(const RayCaster& caster, std::span<const CellFace> faces,
                                            const AimedViewOptions& options, std::uint64_t seed);

}  // namespace vantage
