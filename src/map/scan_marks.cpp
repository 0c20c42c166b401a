// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <map/scan_marks.hpp>
#include <new>

namespace vantage {
namespace {

// Bits that hold the numbers below `count`.
unsigned bits_for(std::int32_t count) { return static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(count - 1))); }

// The bricks of `cells`; if they hold too many cells, those within the largest distance of `origin` that does not.
VoxelBox bricks_around(const VoxelBox& cells, const VoxelIndex& origin) {
  const VoxelBox all{Brick::of_cell(cells.lo), Brick::of_cell(cells.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}};
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

}  // namespace

ScanMarks::ScanMarks(const VoxelBox& cells, const VoxelIndex& origin) : bricks_(bricks_around(cells, origin)) {
  window_ = {Brick::first_cell(bricks_.lo), Brick::first_cell(bricks_.hi)};
  const VoxelIndex extent = bricks_.extent();
  shift_ = {9, 9 + bits_for(extent.x), 9 + bits_for(extent.x) + bits_for(extent.y)};
  words_ = (static_cast<std::size_t>(extent.z) << shift_[2]) / 64;
  passed_ = zeros(words_ + 1);
  hit_ = zeros(words_);
}

// Not a vector: pages of calloc that no ray touches are never written.
ScanMarks::Plane ScanMarks::zeros(std::size_t words) {
  Plane plane(static_cast<std::uint64_t*>(std::calloc(std::max<std::size_t>(words, 1), sizeof(std::uint64_t))));
  if (plane == nullptr) {
    throw std::bad_alloc();
  }
  return plane;
}

BrickMarks& ScanMarks::far_brick(const VoxelIndex& brick) {
  const auto [place, is_new] = far_.try_emplace(brick);
  if (is_new) {
    far_order_.push_back(brick);
  }
  return place->second;
}

}  // namespace vantage
