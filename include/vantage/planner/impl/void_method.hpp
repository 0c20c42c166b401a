// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vantage/frontier/frontier_voids.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/view/void_views.hpp>

namespace vantage::detail {

/// The constants of a VoidMode.
struct VoidMethod {
  FrontierShare share = FrontierShare::TouchingCells;  // the frontier cells through which a void is observed
  // Whether voids are clustered tile by tile (VoidClusterTracker), at a cost that follows what has changed, or all
  // together, at a cost that follows their volume.
  bool in_tiles = true;
  VoidSampling sampling = {};  // how views are drawn
  // If there are more views than this, all are first ranked with a sixteenth of the rays, this many of the best again
  // with a quarter, and `best` of these with all.
  std::size_t finalists = 5;
  std::size_t best = 2;
  double opaque_share = 0.05;          // UnknownSightOptions::opaque_share. With 1, the first void cell ends a ray.
  double opaque_beside_surface = 0.5;  // UnknownSightOptions::opaque_beside_surface
  // Void cells that a view should observe with at least this probability, and that stay unknown, count as looked at
  // in vain. With 1, only cells in which its rays certainly end.
  double sought_chance = 1.0;

  [[nodiscard]] static VoidMethod of(VoidMode mode) {
    switch (mode) {
      case VoidMode::Exploring:
        break;
      case VoidMode::Faithful:
        return {.share = FrontierShare::WholeClusters,
                .in_tiles = false,
                .sampling = {.place_spacing_m = 0.0, .aimed = false},
                .finalists = std::numeric_limits<std::size_t>::max(),
                .opaque_share = 1.0,
                .opaque_beside_surface = 1.0};
      case VoidMode::Searching:
        return {.in_tiles = false,
                .sampling = {.orientations_per_place = 8, .place_spacing_m = 0.1},
                .finalists = 30,
                .best = 30,
                .sought_chance = 0.0};
    }
    return {};
  }
};

}  // namespace vantage::detail
