// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/robot/reachable_space.hpp>

#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/map/impl/connected_cells.hpp>

namespace vantage {
namespace detail {

// The nearest admitted cell to which the platform can move, the current one first. Ties are broken by the order of
// the cells.
inline std::optional<VoxelIndex> nearest_admitted(const OccupancyMap& map, const Platform& platform,
                                                  const Pose& current, const AdmittedCells& admitted) {
  const VoxelFrame& frame = map.frame();
  const VoxelIndex home = frame.cell_of(current.translation());
  // Distances are computed once: what is compared must not depend on how a compiler rounds in each comparison.
  std::vector<std::pair<double, VoxelIndex>> candidates;
  // A body pressed against a wall must be able to move away by half its size plus one cell.
  constexpr std::int32_t kMostCells = 16;
  const double half_m = 0.5 * platform.body_box(current).extent().maxCoeff();
  const std::int32_t near = std::clamp(frame.cells_up_to(half_m) + 1, 2, kMostCells);
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(near), [&](const VoxelIndex& cell) {
    if (admitted.contains(cell)) {
      const double distance_m = (frame.centre_of(cell) - current.translation()).norm();
      candidates.emplace_back(cell == home ? -1.0 : distance_m, cell);
    }
  });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [distance_m, cell] : candidates) {
    Pose there = current;
    there.translation() = frame.centre_of(cell);
    if (platform.admits_motion(map, current, there)) {
      return cell;
    }
  }
  return std::nullopt;
}

inline void fill_from(const BrickSet& cells, const VoxelIndex& tile, std::span<BrickPlane> bricks) {
  for_each_cell(Brick::cells_of(tile), [&](const VoxelIndex& brick) {
    if (const BrickPlane* const held = cells.find(brick)) {
      bricks[ConnectedCells::in_tile(brick)] = *held;
    }
  });
}

}  // namespace detail

VANTAGE_INLINE ReachableSpace::ReachableSpace() = default;
VANTAGE_INLINE ReachableSpace::ReachableSpace(ReachableSpace&&) noexcept = default;
VANTAGE_INLINE ReachableSpace& ReachableSpace::operator=(ReachableSpace&&) noexcept = default;
VANTAGE_INLINE ReachableSpace::~ReachableSpace() = default;

VANTAGE_INLINE ReachableSpace::ReachableSpace(const OccupancyMap& map, const Platform& platform,
                                              const Pose& current) {
  follow(map, platform, current);
}

VANTAGE_INLINE ReachableSpace::ReachableSpace(const VoxelFrame& frame, const std::vector<VoxelIndex>& cells)
    : frame_(frame), start_(cells.front()) {
  for (const VoxelIndex& cell : cells) {
    cells_.insert(cell);
    changed_.push_back(Brick::of_cell(cell));
  }
  count();
}

VANTAGE_INLINE void ReachableSpace::follow(const OccupancyMap& map, const Platform& platform, const Pose& current) {
  // The platform is asked first: if it throws, the next call still knows what has changed.
  admitted_.follow(map, platform);
  if (admitted_.started_anew() || connected_ == nullptr) {
    connected_ = std::make_unique<detail::ConnectedCells>();
    is_another_ = true;
  }
  for (const VoxelIndex& brick : admitted_.changed()) {
    connected_->changed(Brick::of_cell(brick));
  }
  const bool addressable = map.frame().addressable(current.translation());
  const auto start = addressable ? detail::nearest_admitted(map, platform, current, admitted_) : std::nullopt;
  const bool stands = !start && platform.admits(map, current);

  changed_.clear();
  started_anew_ = std::exchange(is_another_, false);
  if (started_anew_) {
    cells_ = BrickSet();
    bricks_.clear();
  } else if (stands_at_m_) {
    assign(Brick::of_cell(*start_), BrickPlane{});
  }
  frame_ = map.frame();
  start_ = stands ? frame_.cell_of(current.translation()) : start;
  stands_at_m_ = stands ? std::optional<Eigen::Vector3d>(current.translation()) : std::nullopt;
  const std::vector<VoxelIndex> starts(start ? 1 : 0, start.value_or(VoxelIndex{}));
  connected_->connect(
      starts,
      [&](const VoxelIndex& tile, std::span<BrickPlane> bricks) {
        detail::fill_from(admitted_.cells(), tile, bricks);
      },
      [&](const VoxelIndex& brick, const BrickPlane& cells) { assign(brick, cells); });
  if (stands) {
    cells_.insert(*start_);
    changed_.push_back(Brick::of_cell(*start_));
  }
  count();
}

VANTAGE_INLINE void ReachableSpace::assign(const VoxelIndex& brick, const BrickPlane& cells) {
  if (cells_.assign(brick, cells)) {
    changed_.push_back(brick);
  }
}

// Merges the changed bricks into the list of bricks.
VANTAGE_INLINE void ReachableSpace::count() {
  sort_unique(changed_);
  if (changed_.empty() && !started_anew_) {
    return;
  }
  std::vector<Stored> merged;
  merged.reserve(bricks_.size() + changed_.size());
  auto old = bricks_.cbegin();
  const auto keep_up_to = [&](auto end) { merged.insert(merged.end(), old, end); };
  for (const VoxelIndex& address : changed_) {
    const auto place = std::find_if(old, bricks_.cend(),
                                    [&](const Stored& brick) { return !RasterOrder{}(brick.address, address); });
    keep_up_to(place);
    old = place != bricks_.cend() && place->address == address ? place + 1 : place;
    if (const std::size_t cells = detail::size_of(*cells_.find(address)); cells > 0) {
      merged.push_back({address, cells, 0});
    }
  }
  keep_up_to(bricks_.cend());
  bricks_ = std::move(merged);
  size_ = 0;
  for (Stored& brick : bricks_) {
    brick.first = std::exchange(size_, size_ + brick.count);
  }
}

VANTAGE_INLINE std::vector<VoxelIndex> ReachableSpace::cells() const {
  std::vector<VoxelIndex> all;
  all.reserve(size_);
  for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) { detail::append(cells, brick, all); });
  return all;
}

VANTAGE_INLINE VoxelIndex ReachableSpace::cell(std::size_t position) const {
  const auto after = std::upper_bound(bricks_.begin(), bricks_.end(), position,
                                      [](std::size_t wanted, const Stored& brick) { return wanted < brick.first; });
  const Stored& brick = *(after - 1);
  const BrickPlane& cells = *cells_.find(brick.address);
  std::size_t left = position - brick.first;
  std::size_t word = 0;
  while (left >= static_cast<std::size_t>(std::popcount(cells[word]))) {
    left -= static_cast<std::size_t>(std::popcount(cells[word++]));
  }
  std::uint64_t bits = cells[word];
  for (; left > 0; --left) {
    bits &= bits - 1;
  }
  return Brick::cell_at(brick.address, 64 * word + static_cast<std::size_t>(std::countr_zero(bits)));
}

VANTAGE_INLINE bool ReachableSpace::any_in(const VoxelBox& cells) const {
  if (cells.empty()) {
    return false;
  }
  const auto any_of = [&](const VoxelIndex& brick, const BrickPlane& reached) {
    const VoxelIndex first = Brick::first_cell(brick);
    bool found = cells.contains(first) && cells.contains(first + VoxelIndex{7, 7, 7}) && reached != BrickPlane{};
    for (std::size_t word = 0; word < Brick::kWords && !found; ++word) {
      for_each_offset(reached[word], word,
                      [&](std::size_t offset) { found = found || cells.contains(first + Brick::cell_at(offset)); });
    }
    return found;
  };
  const VoxelBox bricks = Brick::over(cells);
  const VoxelIndex extent = bricks.extent();
  if (1.0 * extent.x * extent.y * extent.z > static_cast<double>(bricks_.size())) {
    return std::any_of(bricks_.begin(), bricks_.end(),
                       [&](const Stored& brick) { return any_of(brick.address, *cells_.find(brick.address)); });
  }
  for (std::int32_t z = bricks.lo.z; z < bricks.hi.z; ++z) {
    for (std::int32_t y = bricks.lo.y; y < bricks.hi.y; ++y) {
      for (std::int32_t x = bricks.lo.x; x < bricks.hi.x; ++x) {
        const BrickPlane* reached = cells_.find({x, y, z});
        if (reached != nullptr && any_of({x, y, z}, *reached)) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace vantage
