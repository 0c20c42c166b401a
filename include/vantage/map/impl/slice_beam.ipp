// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <vantage/geometry/impl/along.hpp>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/map/impl/slice_beam.hpp>

namespace vantage::detail {

VANTAGE_INLINE void measure(const RayBlock& block, const Eigen::Vector3d& origin, double size_m, RayExtents& extents,
                            InstructionSet set) {
  compiled_for(set, [&block, &origin, &extents, per_metre = 1.0 / size_m] {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = origin[static_cast<Eigen::Index>(axis)];
      const double* const end = block.end[axis].data();
      double* const extent = extents[axis].data();
      VANTAGE_INDEPENDENT
      for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
        extent[i] = (end[i] - from) * per_metre;
      }
    }
  });
}

VANTAGE_INLINE void RayLines::place(const RayExtents& extents, const SliceAxes& axes, InstructionSet set) {
  compiled_for(set, [forwards = extents[axes.major].data(), extent_u = extents[axes.u].data(),
                     extent_v = extents[axes.v].data(), sign = axes.up ? 1.0 : -1.0, slope_u = slope[0].data(),
                     slope_v = slope[1].data(), lengths = length.data()] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      const double along = sign * forwards[i];
      const double per_cell = 1.0 / along;
      slope_u[i] = extent_u[i] * per_cell;
      slope_v[i] = extent_v[i] * per_cell;
      lengths[i] = along;
    }
  });
}

VANTAGE_INLINE SliceBeam::SliceBeam(const VoxelFrame& frame, const Eigen::Vector3d& origin, std::int32_t of_class) {
  const VoxelIndex cell = frame.cell_of(origin);
  const std::array<std::int32_t, 3> cells{cell.x, cell.y, cell.z};
  const auto place_in_cell = [&](std::size_t axis) {
    return origin[static_cast<Eigen::Index>(axis)] / frame.size_m - cells[axis];
  };
  axes.major = static_cast<std::size_t>(of_class / 2);
  axes.u = axes.major == 0 ? 1 : 0;
  axes.v = axes.major == 2 ? 1 : 2;
  axes.up = of_class % 2 == 1;
  first_along = cells[axes.major];
  from_entry = axes.up ? place_in_cell(axes.major) : 1.0 - place_in_cell(axes.major);
  first = {cells[axes.u], cells[axes.v]};
  within = {place_in_cell(axes.u), place_in_cell(axes.v)};
}

VANTAGE_INLINE void SliceBeam::tighten(const RayLines& lines, std::uint64_t active, InstructionSet set) {
  for (std::size_t i = 0; i < 2; ++i) {
    std::tie(least[i], most[i]) = range_of(lines.slope[i], active, set);
  }
}

VANTAGE_INLINE std::int64_t SliceBeam::last_slice_of(const VoxelBox& box) const {
  return axes.up ? std::int64_t{detail::along(box.hi, axes.major)} - 1 - first_along
                 : std::int64_t{first_along} - detail::along(box.lo, axes.major);
}

}  // namespace vantage::detail
