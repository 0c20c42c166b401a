// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map/scan_marks.hpp>
#include <new>

namespace vantage {
namespace {

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
    return static_cast<double>(extent.x) * extent.y * extent.z * static_cast<double>(Brick::kCells) <=
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
  const VoxelIndex size = window_.extent();
  const std::array<std::int32_t, 3> sizes{size.x, size.y, size.z};
  const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(extent.x),
                                          static_cast<std::size_t>(extent.x) * static_cast<std::size_t>(extent.y)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    along_[axis].resize(static_cast<std::size_t>(sizes[axis]));
    for (std::size_t i = 0; i < along_[axis].size(); ++i) {
      const std::size_t in_brick = (i & 3U) << 2U * axis | (i >> 2U & 1U) << (6U + axis);
      along_[axis][i] = static_cast<std::uint32_t>((i >> 3U) * stride[axis] * Brick::kCells + in_brick);
    }
  }
  passed_ = zeros(bricks_.size() * Brick::kWords);
  hit_ = zeros(bricks_.size() * Brick::kWords);
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
