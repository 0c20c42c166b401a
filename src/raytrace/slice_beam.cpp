// SPDX-License-Identifier: MIT
#include <raytrace/slice_beam.hpp>
#include <raytrace/slice_lanes.hpp>

namespace vantage {

static_assert(SliceBeam::kRounding * SliceLanes::kCell + 10 < SliceLanes::kDoubt);

SliceBeam::SliceBeam(const VoxelFrame& frame, const Eigen::Vector3d& origin, std::size_t major, bool up) {
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

std::int64_t SliceBeam::last_slice_of(const VoxelBox& box) const {
  const std::array<std::int32_t, 3> lo{box.lo.x, box.lo.y, box.lo.z};
  const std::array<std::int32_t, 3> hi{box.hi.x, box.hi.y, box.hi.z};
  return axes.up ? std::int64_t{hi[axes.major]} - 1 - first_along : std::int64_t{first_along} - lo[axes.major];
}

}  // namespace vantage
