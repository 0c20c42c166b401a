// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/raytrace/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>

namespace vantage {

static_assert(SliceBeam::kRounding * SliceLanes::kCell + 10 < SliceLanes::kDoubt);

VANTAGE_INLINE SliceBeam::SliceBeam(const VoxelFrame& frame, const Eigen::Vector3d& origin, std::size_t major,
                                    bool up) {
  const VoxelIndex cell = frame.cell_of(origin);
  const std::array<std::int32_t, 3> cells{cell.x, cell.y, cell.z};
  const auto place_in_cell = [&](std::size_t axis) {
    return origin[static_cast<Eigen::Index>(axis)] / frame.size_m - cells[axis];
  };
  axes.major = major;
  axes.u = major == 0 ? 1 : 0;
  axes.v = major == 2 ? 1 : 2;
  axes.up = up;
  first_along = cells[major];
  from_entry = up ? place_in_cell(major) : 1.0 - place_in_cell(major);
  first = {cells[axes.u], cells[axes.v]};
  within = {place_in_cell(axes.u), place_in_cell(axes.v)};
}

VANTAGE_INLINE LateralLayers SliceBeam::layers_from(std::int64_t slice, InstructionSet set) const {
  LateralLayers layers;
  const double enters_first = static_cast<double>(slice) - from_entry;
  const double enters_layer = static_cast<double>(slice + left_in_layer(slice) - 4) - from_entry;
  compiled_for(set, [this, &layers, enters_first, enters_layer] {
    // An offset that makes every position positive, because a conversion to integer then rounds down.
    constexpr double kMore = 2.0 * static_cast<double>(kLastOfLayers);
    for (std::size_t i = 0; i < 2; ++i) {
      const std::int32_t from = first[i] - static_cast<std::int32_t>(kMore);
      const double place = within[i] + kMore;
      const double lower = least[i];
      const double upper = most[i];
      std::int32_t* const lo = layers.lo[i].data();
      std::int32_t* const hi = layers.hi[i].data();
      VANTAGE_INDEPENDENT
#pragma GCC unroll 1
      for (std::int32_t k = 0; k < static_cast<std::int32_t>(LateralLayers::kLayers); ++k) {
        const double start = enters_layer + 4.0 * static_cast<double>(k);
        const double enters = start > enters_first ? start : enters_first;
        const double leaves = start + 4.0;
        const double low = lower * (lower < 0.0 ? leaves : enters);
        const double high = upper * (upper > 0.0 ? leaves : enters);
        lo[k] = from + static_cast<std::int32_t>(place + low - kRounding);
        hi[k] = from + static_cast<std::int32_t>(place + high + kRounding);
      }
    }
  });
  return layers;
}

VANTAGE_INLINE std::int64_t SliceBeam::last_slice_of(const VoxelBox& box) const {
  const std::array<std::int32_t, 3> lo{box.lo.x, box.lo.y, box.lo.z};
  const std::array<std::int32_t, 3> hi{box.hi.x, box.hi.y, box.hi.z};
  return axes.up ? std::int64_t{hi[axes.major]} - 1 - first_along : std::int64_t{first_along} - lo[axes.major];
}

}  // namespace vantage
