// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <raytrace/single_walk.hpp>
#include <raytrace/tile_walk.hpp>
#include <vantage/geometry/voxel_ray.hpp>

namespace vantage {
namespace {

constexpr std::size_t kRays = RayBlock::kRays;

std::int32_t round_down(double value) {
  const auto towards_zero = static_cast<std::int32_t>(value);
  return towards_zero - (towards_zero > value ? 1 : 0);
}

// Swaps two bits of the number of every bit of a word: a transposition.
template <unsigned kLow, unsigned kHigh>
std::uint64_t swap_index_bits(std::uint64_t word) {
  constexpr std::uint64_t kMoving = [] {
    std::uint64_t moving = 0;
    for (unsigned bit = 0; bit < 64; ++bit) {
      moving |= (bit >> kLow & 1U) == 1 && (bit >> kHigh & 1U) == 0 ? std::uint64_t{1} << bit : 0;
    }
    return moving;
  }();
  constexpr unsigned kShift = (1U << kHigh) - (1U << kLow);
  const std::uint64_t differing = (word ^ word >> kShift) & kMoving;
  return word ^ differing ^ differing << kShift;
}

// The cells of a word with those of one slice side by side: u runs fastest, then v, then the major axis.
std::uint64_t in_slices(std::uint64_t word, std::size_t major) {
  if (major == 0) {
    word = swap_index_bits<0, 2>(swap_index_bits<1, 3>(word));
  }
  return major == 2 ? word : swap_index_bits<2, 4>(swap_index_bits<3, 5>(word));
}

// FaceCrossings::between, without a branch; `wrong` is 1 where what rounding may have undone has to be put right.
struct Faces {
  std::int64_t next;
  std::int64_t delta;
  std::int64_t wrong;
};
inline Faces faces_between(double from, double to, std::int32_t first, std::int32_t last, double size_m) {
  constexpr auto kUnit = static_cast<double>(FaceCrossings::kEnd);
  const auto up = static_cast<std::int32_t>(last > first);
  const auto crosses = static_cast<std::int64_t>(last != first);
  const double unlimited = kUnit / std::abs(to - from);
  const double per_metre = unlimited < 1e200 ? unlimited : 1e200;
  const double face_m = (first + up) * size_m;
  const double until_face = (face_m - from) * (2 * up - 1) * per_metre;
  const double not_before = until_face > 0.0 ? until_face : 0.0;
  const double step = size_m * per_metre;
  const auto next = static_cast<std::int64_t>(not_before < kUnit ? not_before : kUnit);
  const auto delta = static_cast<std::int64_t>(step < 2.0 * kUnit ? step : 2.0 * kUnit);
  const std::int64_t faces = (last - first) * (2 * up - 1);
  const std::int64_t last_face = next + (faces - 1) * delta;
  const auto too_late = static_cast<std::int64_t>(last_face > FaceCrossings::kEnd);
  const auto too_early = static_cast<std::int64_t>(last_face + delta <= FaceCrossings::kEnd);
  return {crosses * next + (1 - crosses) * FaceCrossings::kNever, crosses * delta, crosses & (too_late | too_early)};
}

}  // namespace

TileWalk::TileWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin,
                   InstructionSet set)
    : grid_(grid), frame_(frame), set_(set), origin_(origin), first_(frame.cell_of(origin)) {
  first_cell_ = {first_.x, first_.y, first_.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    within_first_[axis] = origin[static_cast<Eigen::Index>(axis)] / frame.size_m - first_cell_[axis];
  }
}

void TileWalk::walk(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, TileHits& hits) {
  hits.stopped = 0;
  within_ = within;
  while (rays != 0) {
    time_faces(block, rays);  // anew for each class: following one moves all lanes
    const std::uint64_t of_class = take_class(rays, block);
    rays &= ~of_class;
    constexpr int kFew = 4;
    if (std::popcount(of_class) < kFew || !advances_) {
      walk_singly(block, of_class, hits);
    } else {
      walk_class(block, of_class, hits);
    }
  }
}

void TileWalk::time_faces(const RayBlock& block, std::uint64_t rays) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from = origin_[static_cast<Eigen::Index>(axis)];
    const std::int32_t first = first_cell_[axis];
    const double* const end = block.end[axis].data();
    const std::int32_t* const cell = block.cell[axis].data();
    std::int64_t* const next = lanes_.next[axis].data();
    std::int64_t* const delta = lanes_.delta[axis].data();
    double* const extent = extent_m_[axis].data();
    RayBlock::PerRay<std::int64_t> flags;
    compiled_for(set_, [=, &flags, size_m = frame_.size_m] {
      std::int64_t* const wrong = flags.data();
      VANTAGE_INDEPENDENT
      for (std::size_t i = 0; i < kRays; ++i) {
        const Faces faces = faces_between(from, end[i], first, cell[i], size_m);
        next[i] = faces.next;
        delta[i] = faces.delta;
        wrong[i] = faces.wrong;
        extent[i] = end[i] - from;
      }
    });
    for (std::uint64_t wrong = equal_to(flags, 1, set_) & rays; wrong != 0; wrong &= wrong - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(wrong));
      const FaceCrossings faces = FaceCrossings::between(from, end[i], first, cell[i], frame_.size_m);
      next[i] = faces.next;
      delta[i] = faces.delta;
    }
  }
}

// Those of the rays that advance fastest along the same axis, in the same direction, as the first of them.
std::uint64_t TileWalk::take_class(std::uint64_t rays, const RayBlock& block) {
  constexpr std::int64_t kStays = 6;  // in its first cell
  const std::int64_t* const delta_x = lanes_.delta[0].data();
  const std::int64_t* const delta_y = lanes_.delta[1].data();
  const std::int64_t* const delta_z = lanes_.delta[2].data();
  const std::int32_t* const cell_x = block.cell[0].data();
  const std::int32_t* const cell_y = block.cell[1].data();
  const std::int32_t* const cell_z = block.cell[2].data();
  RayBlock::PerRay<std::int64_t> kinds;
  compiled_for(set_, [=, &kinds, first = first_] {
    constexpr std::int64_t kNever = FaceCrossings::kNever;
    std::int64_t* const kind = kinds.data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < kRays; ++i) {
      const std::int64_t x = delta_x[i] == 0 ? kNever : delta_x[i];
      const std::int64_t y = delta_y[i] == 0 ? kNever : delta_y[i];
      const std::int64_t z = delta_z[i] == 0 ? kNever : delta_z[i];
      const auto by_x = static_cast<std::int64_t>(cell_x[i] > first.x);
      const std::int64_t by_y = 2 + static_cast<std::int64_t>(cell_y[i] > first.y);
      const std::int64_t by_z = 4 + static_cast<std::int64_t>(cell_z[i] > first.z);
      const std::int64_t y_or_z = y < z ? y : z;
      const std::int64_t of_y_or_z = y <= z ? by_y : by_z;
      const std::int64_t fastest = x <= y_or_z ? by_x : of_y_or_z;
      const std::int64_t least = x < y_or_z ? x : y_or_z;
      kind[i] = least == kNever ? kStays : fastest;
    }
  });
  const std::int64_t chosen = kinds[static_cast<std::size_t>(std::countr_zero(rays))];
  advances_ = chosen != kStays;
  lanes_.set_major(static_cast<std::size_t>(chosen / 2 % 3));
  up_ = chosen % 2 == 1;
  return equal_to(kinds, chosen, set_) & rays;
}

void TileWalk::walk_class(const RayBlock& block, std::uint64_t rays, TileHits& hits) {
  const double* const extent_m = extent_m_[lanes_.major].data();
  for (std::size_t lateral = 0; lateral < 2; ++lateral) {
    const std::size_t axis = lateral == 0 ? lanes_.u : lanes_.v;
    const double* const extent = extent_m_[axis].data();
    const std::int32_t* const cell = block.cell[axis].data();
    const std::int32_t first = first_cell_[axis];
    double* const slope = slope_[lateral].data();
    std::int64_t* const step = (lateral == 0 ? lanes_.step_u : lanes_.step_v).data();
    const std::int64_t stride = lateral == 0 ? 1 : SliceWindows::kWidth;
    compiled_for(set_, [=] {
      VANTAGE_INDEPENDENT
      for (std::size_t i = 0; i < kRays; ++i) {
        slope[i] = extent[i] / std::abs(extent_m[i]);
        step[i] = cell[i] >= first ? stride : -stride;
      }
    });
  }
  lanes_.at.fill(0);
  follow(block, rays, 0, hits);
}

// `slice` is where the lanes are; the beam runs ahead of them.
void TileWalk::follow(const RayBlock& block, std::uint64_t active, std::int64_t slice, TileHits& hits) {
  const std::int64_t last = last_slice(block, active);
  Spread spread = spread_of(active);
  std::int64_t beam = slice;
  while (active != 0 && beam <= last) {
    const std::int32_t along = first_cell_[lanes_.major] + static_cast<std::int32_t>(up_ ? beam : -beam);
    const std::int32_t count = up_ ? 4 - (along & 3) : (along & 3) + 1;
    const Window window = window_of(spread, beam, beam + count - 1);
    const Window words{{window.lo[0] >> 2, window.lo[1] >> 2}, {window.hi[0] >> 2, window.hi[1] >> 2}};
    const std::int32_t layers = free_layers(words, along >> 2);
    if (layers > 0) {
      beam += count + 4 * (layers - 1);
      continue;
    }
    if (words.hi[0] - words.lo[0] >= SliceWindows::kWidth / 4 ||
        words.hi[1] - words.lo[1] >= SliceWindows::kHeight / 4) {
      constexpr int kFew = 16;
      if (std::popcount(active) <= kFew) {
        walk_singly(block, active, hits);
        return;
      }
      for (unsigned quarter = 0; quarter < 4; ++quarter) {
        follow(block, active & std::uint64_t{0xFFFF} << 16U * quarter, slice, hits);
      }
      return;
    }
    if (fill_windows(window, beam, static_cast<std::size_t>(count))) {
      if (beam > slice) {
        active &= ~skip_slices(lanes_, beam - slice, active, set_);
      }
      SliceHits of_slices;
      walk_slices(lanes_, windows_, active, of_slices, set_);
      slice = beam + count;
      take_hits(of_slices, beam, hits);
      active &= ~(of_slices.stopped | of_slices.ended);
      spread = spread_of(active);
    }
    beam += count;
  }
}

void TileWalk::walk_singly(const RayBlock& block, std::uint64_t rays, TileHits& hits) const {
  for (; rays != 0; rays &= rays - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rays));
    SingleWalk walk(frame_, origin_, first_, {block.end[0][i], block.end[1][i], block.end[2][i]},
                    {block.cell[0][i], block.cell[1][i], block.cell[2][i]});
    if (walk.advance(grid_)) {
      hits.stopped |= std::uint64_t{1} << i;
      const VoxelIndex cell = walk.cell();
      hits.cell[0][i] = cell.x;
      hits.cell[1][i] = cell.y;
      hits.cell[2][i] = cell.z;
    }
  }
}

// The last slice in which a ray may still meet a cell that is asked for.
std::int64_t TileWalk::last_slice(const RayBlock& block, std::uint64_t rays) const {
  const std::size_t major = lanes_.major;
  const std::int32_t first = first_cell_[major];
  const std::array<std::int32_t, 3> lo{within_.lo.x, within_.lo.y, within_.lo.z};
  const std::array<std::int32_t, 3> hi{within_.hi.x, within_.hi.y, within_.hi.z};
  const std::int64_t of_box = up_ ? std::int64_t{hi[major]} - 1 - first : std::int64_t{first} - lo[major];
  std::int64_t furthest = 0;
  for (; rays != 0; rays &= rays - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rays));
    furthest = std::max<std::int64_t>(furthest, std::abs(block.cell[major][i] - first));
  }
  return std::min(of_box, furthest);
}

TileWalk::Spread TileWalk::spread_of(std::uint64_t active) const {
  const auto [least_u, most_u] = range_of(slope_[0], active, set_);
  const auto [least_v, most_v] = range_of(slope_[1], active, set_);
  return {{least_u, least_v}, {most_u, most_v}};
}

// The lateral cells that rays of this spread may be in from the first to the last slice.
TileWalk::Window TileWalk::window_of(const Spread& spread, std::int64_t first, std::int64_t last) const {
  constexpr double kRounding = 1e-6;  // far more than the clock of a walk and these sums can differ, in cells
  constexpr auto kFurthest = static_cast<double>(kFurthestVoxel);
  const double of_origin = up_ ? within_first_[lanes_.major] : 1.0 - within_first_[lanes_.major];
  const double enters = std::max(static_cast<double>(first) - of_origin, 0.0);
  const double leaves = static_cast<double>(last) + 1.0 - of_origin;
  Window window{};
  const std::array<std::size_t, 2> axes{lanes_.u, lanes_.v};
  for (std::size_t lateral = 0; lateral < 2; ++lateral) {
    const double least = spread.least[lateral];
    const double most = spread.most[lateral];
    const double from = within_first_[axes[lateral]];
    const double lo = from + least * (least < 0.0 ? leaves : enters) - kRounding;
    const double hi = from + most * (most > 0.0 ? leaves : enters) + kRounding;
    window.lo[lateral] = first_cell_[axes[lateral]] + round_down(std::clamp(lo, -kFurthest, kFurthest));
    window.hi[lateral] = first_cell_[axes[lateral]] + round_down(std::clamp(hi, -kFurthest, kFurthest));
  }
  return window;
}

// How many layers of words, from this one on, stop nothing wherever rays may go from these words of it: no ray gets
// further sideways than forwards.
std::int32_t TileWalk::free_layers(const Window& words, std::int32_t along) const {
  std::int32_t layers = BlockingGrid::kFurthest;
  for (std::int32_t v = words.lo[1]; v <= words.hi[1] && layers > 0; ++v) {
    for (std::int32_t u = words.lo[0]; u <= words.hi[0]; ++u) {
      layers = std::min<std::int32_t>(layers, grid_.distance(word_at(along, u, v)));
    }
  }
  return layers;
}

// Makes the windows of `count` slices of one layer of words; false: no cell in which rays may be stops them.
bool TileWalk::fill_windows(const Window& window, std::int64_t slice, std::size_t count) {
  const std::int32_t along = first_cell_[lanes_.major] + static_cast<std::int32_t>(up_ ? slice : -slice);
  const std::int32_t first_u = window.lo[0] >> 2;
  const std::int32_t first_v = window.lo[1] >> 2;
  windows_.count = count;
  windows_.rows = {};
  window_cell_ = {first_u * 4, first_v * 4};
  windows_.origin = window_cell_[0] - first_cell_[lanes_.u] +
                    std::int64_t{SliceWindows::kWidth} * (window_cell_[1] - first_cell_[lanes_.v]);
  for (std::int32_t v = first_v; v <= window.hi[1] >> 2; ++v) {
    for (std::int32_t u = first_u; u <= window.hi[0] >> 2; ++u) {
      const std::uint64_t word = grid_.blocking(word_at(along >> 2, u, v));
      if (word == 0) {
        continue;
      }
      const std::uint64_t slices = in_slices(word, lanes_.major);
      const auto row = static_cast<std::size_t>(v - first_v) * 4;
      const auto shift = static_cast<unsigned>(u - first_u) * 4U;
      for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<unsigned>(
            (up_ ? along + static_cast<std::int32_t>(i) : along - static_cast<std::int32_t>(i)) & 3);
        const auto cells = static_cast<std::uint32_t>(slices >> 16U * at & 0xFFFFU);
        for (unsigned r = 0; r < 4; ++r) {
          windows_.rows[i][row + r] |= (cells >> 4U * r & 15U) << shift;
        }
      }
    }
  }
  const std::int32_t u_lo = window.lo[0] - first_u * 4;
  const std::int32_t u_hi = window.hi[0] - first_u * 4;
  const std::uint32_t columns = ~std::uint32_t{0} << u_lo & ~std::uint32_t{0} >> (SliceWindows::kWidth - 1 - u_hi);
  std::uint32_t any = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::int32_t v = window.lo[1]; v <= window.hi[1]; ++v) {
      any |= windows_.rows[i][static_cast<std::size_t>(v - first_v * 4)] & columns;
    }
  }
  return any != 0;
}

void TileWalk::take_hits(const SliceHits& of_slices, std::int64_t slice, TileHits& hits) const {
  hits.stopped |= of_slices.stopped;
  const std::int32_t along = first_cell_[lanes_.major];
  for (std::uint64_t left = of_slices.stopped; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const auto forward = static_cast<std::int32_t>(slice + of_slices.slice[i]);
    const auto within = static_cast<std::int32_t>(of_slices.within[i]);
    hits.cell[lanes_.major][i] = up_ ? along + forward : along - forward;
    hits.cell[lanes_.u][i] = window_cell_[0] + (within & (SliceWindows::kWidth - 1));
    hits.cell[lanes_.v][i] = window_cell_[1] + within / SliceWindows::kWidth;
  }
}

}  // namespace vantage
