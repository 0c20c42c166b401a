// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <vantage/geometry/impl/along.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/map/impl/undrawn_part.hpp>

namespace vantage::detail {

inline constexpr double kMostSlices = 1 << 16;  // a longer beam is not worth the walk
inline constexpr double kSteepest = 2.0;        // largest slope of a ray

// The rays of a block as a beam through marked cells.
struct MarkedBeam {
  MarkedBeam(const ScanMarks& of_marks, std::uint64_t of_rays, InstructionSet of_set, const SliceBeam& of_beam)
      : marks(of_marks), usable(of_rays), set(of_set), beam(of_beam) {}

  // Whether all cells that the rays may pass in the slices [slice, end) have marks.
  [[nodiscard]] bool is_marked(std::int64_t slice, std::int64_t end, const LateralCells& cells) const {
    const std::int32_t one = beam.along(slice);
    const std::int32_t other = beam.along(end - 1);
    const VoxelIndex lo = beam.axes.at(std::min(one, other), cells.lo[0], cells.lo[1]);
    const VoxelIndex hi = beam.axes.at(std::max(one, other), cells.hi[0], cells.hi[1]);
    return marks.all_marked(box_overlap({lo, hi + VoxelIndex{1, 1, 1}}, marks.window()));
  }

  // The rays that cross at least this many faces along the major axis.
  [[nodiscard]] std::uint64_t rays_with_faces(std::int64_t count) const {
    std::uint64_t rays = 0;
    compiled_for(set, [&rays, of_ray = faces.data(), least = static_cast<double>(count)] {
      for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
        rays |= std::uint64_t{of_ray[i] >= least} << i;
      }
    });
    return rays & usable;
  }

  // The lateral cells of the rays in a slice, if some rays end before it or in it.
  [[nodiscard]] LateralCells ending(std::int64_t slice) const {
    const std::uint64_t active = rays_with_faces(slice);
    LateralCells cells{};
    for (std::size_t side = 0; side < 2; ++side) {
      RayBlock::PerRay<double> less;
      RayBlock::PerRay<double> more;
      compiled_for(
          set, [lo = less.data(), hi = more.data(), slope = lines.slope[side].data(), length = lines.length.data(),
                start = beam.entered_at(slice), end = beam.entered_at(slice + 1)] {
            VANTAGE_INDEPENDENT
            for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
              const double enter = slope[i] * start;
              const double leave = slope[i] * (length[i] < end ? length[i] : end);
              lo[i] = enter < leave ? enter : leave;
              hi[i] = enter < leave ? leave : enter;
            }
          });
      const double from = beam.within[side];
      cells.lo[side] =
          beam.first[side] + SliceBeam::cell_at(from + range_of(less, active, set).first - SliceBeam::kRounding);
      cells.hi[side] =
          beam.first[side] + SliceBeam::cell_at(from + range_of(more, active, set).second + SliceBeam::kRounding);
    }
    return cells;
  }

  // Number of leading slices in which every cell between the rays already has a mark. The first `all_leave` slices
  // are crossed completely by all rays, and `last` is the last slice of any ray.
  [[nodiscard]] std::int64_t marked_slices(std::int64_t all_leave, std::int64_t last) const {
    std::int64_t slice = 0;
    while (slice < all_leave) {
      const std::int64_t end = std::min(all_leave, slice + beam.left_in_layer(slice));
      if (!is_marked(slice, end, beam.cells_in(slice, end - 1))) {
        for (; slice < end; ++slice) {
          if (!is_marked(slice, slice + 1, beam.cells_in(slice, slice))) {
            return slice;
          }
        }
      }
      slice = end;
    }
    while (slice <= last && is_marked(slice, slice + 1, ending(slice))) {
      ++slice;
    }
    return slice;
  }

  const ScanMarks& marks;
  std::uint64_t usable;
  InstructionSet set;
  SliceBeam beam;
  RayLines lines;
  RayBlock::PerRay<double> faces;  // number of faces that each ray crosses along the major axis
};

VANTAGE_INLINE UndrawnPart undrawn_part(const RayBlock& block, std::uint64_t usable, const Eigen::Vector3d& origin,
                                        const VoxelFrame& frame, const ScanMarks& marks) {
  if (!marks.holds_all()) {
    return {usable};
  }
  const InstructionSet set = best_instruction_set();
  const auto ray = static_cast<std::size_t>(std::countr_zero(usable));
  const std::int32_t of_class =
      class_of_ray(block.end[0][ray] - origin.x(), block.end[1][ray] - origin.y(), block.end[2][ray] - origin.z());
  MarkedBeam marked(marks, usable, set, SliceBeam(frame, origin, of_class));
  const std::size_t major = marked.beam.axes.major;
  RayExtents extents;
  measure(block, origin, frame.size_m, extents, set);
  marked.lines.place(extents, marked.beam.axes, set);
  marked.beam.tighten(marked.lines, usable, set);
  compiled_for(set, [of_ray = marked.faces.data(), cell = block.cell[major].data(),
                     sign = marked.beam.axes.up ? 1 : -1, first = marked.beam.first_along] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      of_ray[i] = sign * (cell[i] - first);
    }
  });
  const auto [least, most] = range_of(marked.faces, usable, set);
  const SliceBeam& beam = marked.beam;
  const bool diverge =
      !(std::min(beam.least[0], beam.least[1]) >= -kSteepest) || !(std::max(beam.most[0], beam.most[1]) <= kSteepest);
  if (diverge || least < 0.0 || most > kMostSlices || !(range_of(marked.lines.length, usable, set).first > 0.0)) {
    return {usable, major, 0};
  }
  std::int64_t slices = 0;
  compiled_for(set, [&slices, &marked, all_leave = static_cast<std::int64_t>(least),
                     last = static_cast<std::int64_t>(most)] { slices = marked.marked_slices(all_leave, last); });
  return {slices > 0 ? marked.rays_with_faces(slices) : usable, major, slices};
}

}  // namespace vantage::detail
