// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <vantage/map/impl/scan_marks.hpp>

namespace vantage::detail {

// Number of bits for integers below `count`.
inline unsigned bits_for(std::int32_t count) {
  return static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(count - 1)));
}

// Bit mask of the coordinates first..last, clipped to the four coordinates of a word, with `stride` bits per
// coordinate.
inline std::uint64_t bits_within(std::int32_t first, std::int32_t last, std::int32_t stride) {
  const std::uint64_t below_end =
      last >= 3 && stride == 16 ? 0 : std::uint64_t{1} << (std::min(last, 3) + 1) * stride;
  return below_end - (std::uint64_t{1} << std::max(first, 0) * stride);
}

// The bricks of `cells`. If they have too many cells, a smaller box of bricks around `origin`: the half extent is
// halved until it fits.
inline VoxelBox bricks_around(const VoxelBox& cells, const VoxelIndex& origin) {
  const VoxelBox all = Brick::over(cells);
  const VoxelIndex centre = Brick::of_cell(origin);
  const auto within = [&](std::int32_t reach) {
    return VoxelBox{{std::max(all.lo.x, centre.x - reach), std::max(all.lo.y, centre.y - reach),
                     std::max(all.lo.z, centre.z - reach)},
                    {std::min(all.hi.x, centre.x + reach + 1), std::min(all.hi.y, centre.y + reach + 1),
                     std::min(all.hi.z, centre.z + reach + 1)}};
  };
  const auto fits = [](const VoxelBox& box) {
    const VoxelIndex extent = box.extent();
    return std::ldexp(extent.z, static_cast<int>(9 + bits_for(extent.x) + bits_for(extent.y))) <=
           static_cast<double>(ScanMarks::kMaxWindow);
  };
  std::int32_t reach = (kFurthestVoxel >> 3) + 1;
  while (!fits(within(reach))) {
    reach /= 2;
  }
  return within(reach);
}

VANTAGE_INLINE ScanMarks::ScanMarks(const VoxelBox& cells, const VoxelIndex& origin)
    : bricks_(bricks_around(cells, origin)) {
  window_ = Brick::cells_of(bricks_);
  holds_all_ = window_.contains(cells.lo) && window_.contains(cells.hi - VoxelIndex{1, 1, 1});
  const VoxelIndex extent = bricks_.extent();
  shift_ = {9, 9 + bits_for(extent.x), 9 + bits_for(extent.x) + bits_for(extent.y)};
  words_ = (static_cast<std::size_t>(extent.z) << shift_[2]) / 64;
  passed_ = zeros(words_ + 1);
  hit_ = zeros(words_);
}

VANTAGE_INLINE ScanMarks ScanMarks::clipped_to(const VoxelBox& clip, const VoxelIndex& origin) {
  const VoxelIndex nearest{std::clamp(origin.x, clip.lo.x, clip.hi.x - 1),
                           std::clamp(origin.y, clip.lo.y, clip.hi.y - 1),
                           std::clamp(origin.z, clip.lo.z, clip.hi.z - 1)};
  ScanMarks marks(clip, nearest);
  marks.clip_ = clip;
  return marks;
}

// calloc instead of a vector: the system provides zeroed pages lazily, so untouched pages cost nothing.
VANTAGE_INLINE ScanMarks::Plane ScanMarks::zeros(std::size_t words) {
  Plane plane(static_cast<std::uint64_t*>(std::calloc(std::max<std::size_t>(words, 1), sizeof(std::uint64_t))));
  if (plane == nullptr) {
    throw std::bad_alloc();
  }
  return plane;
}

VANTAGE_INLINE bool ScanMarks::all_marked(const VoxelBox& cells) const {
  const VoxelIndex first = cells.lo - window_.lo;
  const VoxelIndex last = cells.hi - window_.lo - VoxelIndex{1, 1, 1};
  for (std::int32_t z = first.z & ~3; z <= last.z; z += 4) {
    const std::uint64_t in_z = bits_within(first.z - z, last.z - z, 16);
    const std::uint64_t part_z = part(2, window_.lo.z + z);
    for (std::int32_t y = first.y & ~3; y <= last.y; y += 4) {
      const std::uint64_t in_yz = in_z & (bits_within(first.y - y, last.y - y, 4) & 0xFFFFU) * 0x0001000100010001ULL;
      const std::uint64_t part_yz = part(1, window_.lo.y + y) | part_z;
      for (std::int32_t x = first.x & ~3; x <= last.x; x += 4) {
        const std::uint64_t in_word =
            in_yz & (bits_within(first.x - x, last.x - x, 1) & 0xFU) * 0x1111111111111111ULL;
        const std::uint64_t word = (part(0, window_.lo.x + x) | part_yz) >> 6U;
        if ((in_word & ~(passed_[word] | hit_[word])) != 0) {
          return false;
        }
      }
    }
  }
  return true;
}

VANTAGE_INLINE void ScanMarks::unmark_passed(const VoxelIndex& cell) {
  const std::uint64_t position = in_window(cell) ? position_of(cell) : Brick::offset_of(cell);
  std::uint64_t* plane = passed_.get();
  if (!in_window(cell)) {
    BrickMarks* const far = far_brick(Brick::of_cell(cell));
    if (far == nullptr) {
      return;
    }
    plane = far->passed.data();
  }
  plane[position >> 6U] &= ~(std::uint64_t{1} << (position & 63U));
}

VANTAGE_INLINE BrickMarks* ScanMarks::far_brick(const VoxelIndex& brick) {
  // the brick of the last call is cached, because a ray stays in a brick for some steps
  if (last_far_ == nullptr || brick != last_far_->address) {
    BrickDirectory::Number number = far_numbers_.find(brick);
    if (number == BrickDirectory::kNone) {
      if (far_.size() == kMaxFarBricks) {
        return nullptr;
      }
      number = static_cast<BrickDirectory::Number>(far_.size());
      far_numbers_.place(brick) = number;
      far_.emplace_back().address = brick;
    }
    last_far_ = &far_[number];
  }
  return &last_far_->marks;
}

}  // namespace vantage::detail
