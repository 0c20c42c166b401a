// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/map/impl/grazed_cells.hpp>
#include <vantage/map/impl/mark_rays.hpp>
#include <vantage/map/impl/update_word.hpp>
#include <vantage/map/occupancy_map.hpp>

#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage {

/// Inserts a scan in two phases, so that each cell gets at most one update:
///
///     scan -> blocks of 64 rays (ScanRays) -> cells passed and hit, as bit planes (mark_rays, ScanMarks)
///          -> surfaces at grazing angles removed (unmark_grazed_cells) -> log-odds, 64 cells at a time (update_word)
class ScanInserter {
 public:
  explicit ScanInserter(OccupancyMap& map)
      : map_(map), model_{map.hit_steps_, map.miss_steps_, map.min_steps_, map.max_steps_} {}

  ScanReport insert(const ScanView& scan, RayPolicy policy) {
    const detail::ScanRays rays(scan, map_.frame_);
    report_ = rays.report();
    map_.begin_revision();
    if (!rays.empty()) {
      const std::optional<VoxelBox> clip = clip_of(rays.cells());
      if (clip && clip->empty()) {
        return report_;
      }
      const VoxelIndex origin = map_.frame_.cell_of(rays.origin());
      detail::ScanMarks marks =
          clip ? detail::ScanMarks::clipped_to(*clip, origin) : detail::ScanMarks(rays.cells(), origin);
      detail::mark_rays(rays, map_.frame_, policy, marks);
      if (map_.options_.keep_grazed_cells) {
        detail::unmark_grazed_cells(rays, map_, policy, marks);
      }
      marks.for_each_marked_brick([this](const VoxelIndex& address, const std::uint64_t* passed,
                                         const std::uint64_t* hit) { update(address, passed, hit); });
      refuse(marks.dropped());
    }
    return report_;
  }

 private:
  // The cells to which rays are clipped: the region and one layer of cells around it. nullopt if the region covers
  // most of the bounding box of the rays; without a clip, neighbouring rays can be drawn together, which is faster.
  [[nodiscard]] std::optional<VoxelBox> clip_of(const VoxelBox& cells) const {
    constexpr double kMost = 0.25;
    const auto volume = [](const VoxelBox& box) { return 1.0 * box.extent().x * box.extent().y * box.extent().z; };
    const VoxelBox inside = map_.region_ ? detail::box_overlap(cells, map_.region_->grown(1)) : cells;
    return volume(inside) < kMost * volume(cells) ? std::optional(inside) : std::nullopt;
  }
  void update(const VoxelIndex& address, const std::uint64_t* passed, const std::uint64_t* hit) {
    detail::BrickMarks marks;
    const bool cut = map_.region_ && !inside(address, *map_.region_);
    std::uint64_t any = 0;
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      const std::uint64_t allowed = cut ? allowed_in(address, word) : ~std::uint64_t{0};
      marks.hit[word] = hit[word] & allowed;
      marks.passed[word] = passed[word] & ~hit[word] & allowed;
      any |= marks.hit[word] | marks.passed[word];
    }
    if (any == 0) {
      return;
    }
    const BrickDirectory::Number number = map_.brick_for(address);
    if (number == BrickDirectory::kNone) {
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        refuse(detail::bits_in(marks.hit[word] | marks.passed[word]));
      }
      return;
    }
    if (map_.bricks_.is_shared(number) && !detail::any(marks.hit)) {
      for (const std::uint64_t passed_cells : marks.passed) {  // as free as can be already
        report_.cells_cleared += detail::bits_in(passed_cells);
      }
      return;
    }
    Brick& brick = map_.writing(number);
    if (update_brick(brick, marks)) {
      map_.mark_changed(number);
      map_.grow_bounds(address, brick);
    }
  }

  void refuse(std::size_t cells) {
    report_.cells_refused += cells;
    map_.cells_refused_ += cells;
  }

  // Returns whether a cell of the brick has changed its state.
  bool update_brick(Brick& brick, const detail::BrickMarks& marks) {
    std::uint64_t any_change = 0;
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      const std::uint64_t touched = marks.hit[word] | marks.passed[word];
      if (touched == 0) {
        continue;
      }
      const std::uint64_t positive =
          detail::update_word(&brick.log_odds[word * 64], marks.hit[word], marks.passed[word], model_);
      const std::uint64_t occupied = (brick.occupied[word] & ~touched) | (positive & touched);
      const std::uint64_t changed = (touched & ~brick.known[word]) | (occupied ^ brick.occupied[word]);
      brick.known[word] |= touched;
      brick.occupied[word] = occupied;
      any_change |= changed;
      report_.cells_hit += detail::bits_in(marks.hit[word]);
      report_.cells_cleared += detail::bits_in(marks.passed[word]);
      report_.cells_changed += detail::bits_in(changed);
    }
    return any_change != 0;
  }

  static bool inside(const VoxelIndex& address, const VoxelBox& region) {
    const VoxelIndex corner = Brick::first_cell(address);
    return region.contains(corner) && region.contains(corner + VoxelIndex{7, 7, 7});
  }
  [[nodiscard]] std::uint64_t allowed_in(const VoxelIndex& address, std::size_t word) const {
    const VoxelIndex corner = Brick::first_cell(address);
    std::uint64_t allowed = 0;
    for_each_offset(~std::uint64_t{0}, word, [&](std::size_t offset) {
      const bool in = map_.region_->contains(corner + Brick::cell_at(offset));
      allowed |= std::uint64_t{in} << (offset & 63U);
    });
    return allowed;
  }

  OccupancyMap& map_;
  detail::BeamSteps model_;
  ScanReport report_;
};

VANTAGE_INLINE ScanReport OccupancyMap::insert(const Scan& scan, RayPolicy policy) {
  return insert(scan.view(), policy);
}

VANTAGE_INLINE ScanReport OccupancyMap::insert(const ScanView& scan, RayPolicy policy) {
  return ScanInserter(*this).insert(scan, policy);
}

}  // namespace vantage
