// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vantage/geometry/impl/along.hpp>
#include <vantage/map/impl/tile_beam.hpp>

namespace vantage {
namespace detail {

using Doubles = RayBlock::PerRay<double>;
inline constexpr std::size_t kRays = RayBlock::kRays;

// Margin in cells. The rounding error along a ray of up to kMostSlices slices is much smaller.
inline constexpr double kMargin = 1e-3;
inline constexpr double kMostSlices = 1 << 16;
inline constexpr double kSteepest = 2.0;

struct Range {
  double lo;
  double hi;
};

// Smallest of `a` and largest of `b`, without dependencies between successive values.
inline Range extent_of(const Doubles& a, const Doubles& b) {
  std::array<double, 8> lo;
  std::array<double, 8> hi;
  lo.fill(std::numeric_limits<double>::infinity());
  hi.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < kRays; i += 8) {
    for (std::size_t j = 0; j < 8; ++j) {
      lo[j] = a[i + j] < lo[j] ? a[i + j] : lo[j];
      hi[j] = b[i + j] > hi[j] ? b[i + j] : hi[j];
    }
  }
  return {*std::min_element(lo.begin(), lo.end()), *std::max_element(hi.begin(), hi.end())};
}

// The rays of a block as lines: lateral position as a function of the distance along the major axis, in cells from
// the origin.
template <std::size_t kMajor>
class TileBeam {
 public:
  TileBeam(const RayBlock& block, const Eigen::Vector3d& origin, const VoxelFrame& frame, const ScanMarks& marks)
      : marks_(marks) {
    const VoxelIndex first = frame.cell_of(origin);
    up_ = block.end[kMajor][0] > origin[kMajor];
    const double cells_per_metre = 1.0 / frame.size_m;
    const double start = origin[kMajor];
    const double sign = up_ ? cells_per_metre : -cells_per_metre;
    first_ = along(first, kMajor);
    const double first_face_m = (first_ + (up_ ? 1 : 0)) * frame.size_m;
    to_face_ = (first_face_m - start) * sign;
    for (std::size_t i = 0; i < kRays; ++i) {
      length_[i] = (block.end[kMajor][i] - start) * sign;
      faces_[i] = (up_ ? 1 : -1) * (block.cell[kMajor][i] - first_);
    }
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t axis = kSides[side];
      const double from = origin[static_cast<Eigen::Index>(axis)];
      const VoxelBox& window = marks.window();
      offset_[side] = from * cells_per_metre - along(window.lo, axis);
      extent_[side] = along(window.hi, axis) - along(window.lo, axis);
      lo_[side] = along(window.lo, axis);
      for (std::size_t i = 0; i < kRays; ++i) {
        slope_[side][i] = (block.end[axis][i] - from) * cells_per_metre / length_[i];
      }
      slopes_[side] = extent_of(slope_[side], slope_[side]);
    }
  }

  // The rays that cross at least this many faces along the major axis.
  [[nodiscard]] std::uint64_t rays_with_faces(double faces) const {
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
      rays |= std::uint64_t{faces_[i] >= faces} << i;
    }
    return rays;
  }

  // Number of leading slices in which every cell between the rays already has a mark.
  [[nodiscard]] std::int64_t marked_slices() const {
    const auto [least, most] = extent_of(faces_, faces_);
    const Range shortest = extent_of(length_, length_);
    if (!(shortest.lo > 0.0) || least < 0.0 || most > kMostSlices) {
      return 0;
    }
    for (const Range& slopes : slopes_) {
      if (!(slopes.lo >= -kSteepest) || !(slopes.hi <= kSteepest)) {
        return 0;
      }
    }
    const auto all_leave = static_cast<std::int64_t>(least);
    const auto last = static_cast<std::int64_t>(most);
    std::int64_t slice = 0;
    while (slice < all_leave) {
      const std::int64_t end = std::min(all_leave, slice + slices_in_word(slice));
      if (!is_marked(slice, end, {between(0, slice, end), between(1, slice, end)})) {
        for (; slice < end; ++slice) {
          if (!is_marked(slice, slice + 1, {between(0, slice, slice + 1), between(1, slice, slice + 1)})) {
            return slice;
          }
        }
      }
      slice = end;
    }
    while (slice <= last && is_marked(slice, slice + 1, {ending(0, slice), ending(1, slice)})) {
      ++slice;
    }
    return slice;
  }

 private:
  static constexpr std::array<std::size_t, 2> kSides{(kMajor + 1) % 3, (kMajor + 2) % 3};

  // Distance along the major axis at which a slice begins.
  [[nodiscard]] double start_of(std::int64_t slice) const {
    return slice == 0 ? 0.0 : to_face_ + static_cast<double>(slice - 1);
  }

  // Number of slices, from this one on, that lie in the same words of the marks.
  [[nodiscard]] std::int64_t slices_in_word(std::int64_t slice) const {
    const std::int32_t at = cell_at(slice) & 3;  // windows start at a brick
    return up_ ? 4 - at : at + 1;
  }
  [[nodiscard]] std::int32_t cell_at(std::int64_t slice) const {
    const auto steps = static_cast<std::int32_t>(slice);
    return first_ + (up_ ? steps : -steps);
  }

  // Lateral range of the rays in slices that all of them cross completely.
  [[nodiscard]] Range between(std::size_t side, std::int64_t slice, std::int64_t end) const {
    const double enter = start_of(slice);
    const double leave = start_of(end);
    return {std::min(slopes_[side].lo * enter, slopes_[side].lo * leave),
            std::max(slopes_[side].hi * enter, slopes_[side].hi * leave)};
  }

  // Lateral range of the rays in a slice, if some rays end before it or in it.
  [[nodiscard]] Range ending(std::size_t side, std::int64_t slice) const {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const double start = start_of(slice);
    const double end = start_of(slice + 1);
    const auto faces = static_cast<double>(slice);
    Doubles lo;
    Doubles hi;
    for (std::size_t i = 0; i < kRays; ++i) {
      const double enter = slope_[side][i] * start;
      const double leave = slope_[side][i] * (length_[i] < end ? length_[i] : end);
      const double less = enter < leave ? enter : leave;
      const double more = enter < leave ? leave : enter;
      lo[i] = faces_[i] < faces ? kInf : less;
      hi[i] = faces_[i] < faces ? -kInf : more;
    }
    return extent_of(lo, hi);
  }

  // Whether all cells that the rays may pass in the slices [slice, end) have marks.
  [[nodiscard]] bool is_marked(std::int64_t slice, std::int64_t end, const std::array<Range, 2>& at) const {
    std::array<std::int32_t, 3> lo{};
    std::array<std::int32_t, 3> hi{};
    const std::int32_t one = cell_at(slice);
    const std::int32_t other = cell_at(end - 1);
    lo[kMajor] = std::min(one, other);
    hi[kMajor] = std::max(one, other) + 1;
    for (std::size_t side = 0; side < 2; ++side) {
      const double last = extent_[side] - 1.0;
      const std::size_t axis = kSides[side];
      lo[axis] = lo_[side] + static_cast<std::int32_t>(std::clamp(offset_[side] + at[side].lo - kMargin, 0.0, last));
      hi[axis] =
          lo_[side] + static_cast<std::int32_t>(std::clamp(offset_[side] + at[side].hi + kMargin, 0.0, last)) + 1;
    }
    return marks_.all_marked({{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}});
  }

  const ScanMarks& marks_;
  bool up_ = true;
  std::int32_t first_ = 0;  // cell of the origin along the major axis
  double to_face_ = 0.0;    // distance from the origin to the first face across the major axis
  Doubles length_;          // lengths of the rays along the major axis
  Doubles faces_;           // number of faces each ray crosses across the major axis
  std::array<Doubles, 2> slope_;
  std::array<Range, 2> slopes_{};
  std::array<double, 2> offset_{};  // position of the origin in the window
  std::array<double, 2> extent_{};
  std::array<std::int32_t, 2> lo_{};
};

// The axis along which a ray is longest.
inline std::size_t major_axis(const RayBlock& block, std::size_t ray, const Eigen::Vector3d& origin) {
  std::size_t major = 0;
  double furthest = -1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double step = std::abs(block.end[axis][ray] - origin[static_cast<Eigen::Index>(axis)]);
    major = step > furthest ? axis : major;
    furthest = std::max(step, furthest);
  }
  return major;
}

template <std::size_t kMajor>
UndrawnPart undrawn_part_along(const RayBlock& block, const Eigen::Vector3d& origin, const VoxelFrame& frame,
                               const ScanMarks& marks) {
  UndrawnPart part{~std::uint64_t{0}, kMajor, 0};
  compiled_for(best_instruction_set(), [&] {
    const TileBeam<kMajor> beam(block, origin, frame, marks);
    part.faces_before = beam.marked_slices();
    if (part.faces_before > 0) {
      part.rays = beam.rays_with_faces(static_cast<double>(part.faces_before));
    }
  });
  return part;
}

}  // namespace detail

VANTAGE_INLINE UndrawnPart undrawn_part(RayBlock& block, std::uint64_t usable, const Eigen::Vector3d& origin,
                                        const VoxelFrame& frame, const ScanMarks& marks) {
  if (!marks.holds_all()) {
    return {usable};
  }
  const auto stand_in = static_cast<std::size_t>(std::countr_zero(usable));
  for (std::uint64_t gaps = ~usable; gaps != 0; gaps &= gaps - 1) {
    const auto gap = static_cast<std::size_t>(std::countr_zero(gaps));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.end[axis][gap] = block.end[axis][stand_in];
      block.cell[axis][gap] = block.cell[axis][stand_in];
    }
  }
  const std::size_t major = detail::major_axis(block, stand_in, origin);
  UndrawnPart part = major == 0   ? detail::undrawn_part_along<0>(block, origin, frame, marks)
                     : major == 1 ? detail::undrawn_part_along<1>(block, origin, frame, marks)
                                  : detail::undrawn_part_along<2>(block, origin, frame, marks);
  part.rays &= usable;
  return part;
}

}  // namespace vantage
