// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vantage/map/occupancy_map.hpp>

#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/map/impl/brick_file.hpp>
#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline void validate(const OccupancyMapOptions& options) {
  const auto finite = [](double value) { return std::isfinite(value); };
  detail::require_option(finite(options.resolution_m) && options.resolution_m > 0,
                         "OccupancyMapOptions::resolution_m", options.resolution_m, "> 0");
  detail::require_option(finite(options.log_odds_hit) && options.log_odds_hit > 0,
                         "OccupancyMapOptions::log_odds_hit", options.log_odds_hit, "> 0");
  detail::require_option(finite(options.log_odds_miss) && options.log_odds_miss < 0,
                         "OccupancyMapOptions::log_odds_miss", options.log_odds_miss, "< 0");
  detail::require_option(finite(options.log_odds_min) && options.log_odds_min < 0,
                         "OccupancyMapOptions::log_odds_min", options.log_odds_min, "< 0");
  detail::require_option(finite(options.log_odds_max) && options.log_odds_max > 0,
                         "OccupancyMapOptions::log_odds_max", options.log_odds_max, "> 0");
  detail::require_option(options.erase_range_m > 0, "OccupancyMapOptions::erase_range_m", options.erase_range_m,
                         "> 0");
  if (options.region) {
    const VoxelFrame frame{options.resolution_m};
    if (options.region->empty() || !frame.addressable(options.region->min) ||
        !frame.addressable(options.region->max)) {
      throw std::invalid_argument("OccupancyMapOptions::region must have min < max on every axis and be finite");
    }
  }
}

// The first step of a list that represents all four constants exactly. If there is none, the finest step that fits
// int8.
inline double choose_step(const OccupancyMapOptions& options) {
  const std::array<double, 4> constants{options.log_odds_hit, options.log_odds_miss, options.log_odds_min,
                                        options.log_odds_max};
  const double largest = std::max(-options.log_odds_min, options.log_odds_max);
  for (const double step : {0.05, 0.1, 0.04, 0.03, 0.02}) {
    const bool exact = std::all_of(constants.begin(), constants.end(), [step](double value) {
      return std::abs(value / step - std::round(value / step)) < 1e-9;
    });
    if (exact && largest / step <= 127.0) {
      return step;
    }
  }
  return largest / 127.0;
}

// Whether a coarse cell of this edge contains cells that can be addressed. If so, its corners fit into 32 bits.
inline bool holds_addresses(const VoxelIndex& coarse, std::int32_t edge) {
  const auto near = [edge](std::int32_t i) {
    const std::int64_t first = std::int64_t{i} * edge;
    return first <= kFurthestVoxel && first + edge > -kFurthestVoxel;
  };
  return near(coarse.x) && near(coarse.y) && near(coarse.z);
}

}  // namespace detail

VANTAGE_INLINE OccupancyMap::OccupancyMap(const OccupancyMapOptions& options)
    : options_(options), frame_{options.resolution_m} {
  detail::validate(options);
  step_ = detail::choose_step(options);
  if (options.region) {
    region_ = frame_.cells_centred_in(*options.region);
  }
  const auto steps = [this](double log_odds) {
    const double rounded = std::round(log_odds / step_);
    // A constant below half a step must not vanish.
    return static_cast<std::int8_t>(
        std::clamp(rounded == 0.0 ? std::copysign(1.0, log_odds) : rounded, -127.0, 127.0));
  };
  hit_steps_ = steps(options.log_odds_hit);
  miss_steps_ = steps(options.log_odds_miss);
  min_steps_ = steps(options.log_odds_min);
  max_steps_ = steps(options.log_odds_max);
}

VANTAGE_INLINE OccupancyMap::OccupancyMap(const OccupancyMapOptions& options, const std::string& folder,
                                          std::size_t resident_bytes)
    : OccupancyMap(options) {
  detail::require_option(resident_bytes >= detail::BrickFile::kBlockBytes, "OccupancyMap: resident_bytes",
                         resident_bytes, "at least 65536");
  if (folder.empty()) {
    throw std::invalid_argument("OccupancyMap: folder must not be empty");
  }
  BrickStore on_disk(folder, resident_bytes);
  bricks_.swap(on_disk);
}

VANTAGE_INLINE bool OccupancyMap::contested(const VoxelIndex& cell) const {
  const Brick* brick = find_brick(Brick::of_cell(cell));
  const std::size_t offset = Brick::offset_of(cell);
  return brick != nullptr && brick->at(offset) == Occupancy::Free && shows_a_hit(brick->log_odds[offset]);
}

VANTAGE_INLINE std::optional<double> OccupancyMap::log_odds(const VoxelIndex& cell) const {
  const Brick* brick = find_brick(Brick::of_cell(cell));
  const std::size_t offset = Brick::offset_of(cell);
  if (brick == nullptr || brick->at(offset) == Occupancy::Unknown) {
    return std::nullopt;
  }
  return brick->log_odds[offset] * step_;
}

VANTAGE_INLINE std::optional<double> OccupancyMap::log_odds(const VoxelIndex& coarse, int level,
                                                            CoarseningPolicy policy) const {
  if (level < 0 || level > 16) {
    throw std::invalid_argument("level is " + std::to_string(level) + ", must be in [0, 16]");
  }
  const std::int32_t edge = 1 << level;
  if (!detail::holds_addresses(coarse, edge)) {
    return std::nullopt;
  }
  const VoxelIndex first{coarse.x * edge, coarse.y * edge, coarse.z * edge};
  const VoxelBox cells{first, first + VoxelIndex{edge, edge, edge}};
  std::size_t known = 0;
  std::int64_t sum = 0;
  int largest = -128;
  const auto add_brick = [&](const VoxelIndex& address, const Brick& brick) {
    const VoxelIndex corner = Brick::first_cell(address);
    for_each_offset(brick.known, [&](std::size_t offset) {
      if (cells.contains(corner + Brick::cell_at(offset))) {
        ++known;
        sum += brick.log_odds[offset];
        largest = std::max<int>(largest, brick.log_odds[offset]);
      }
    });
  };
  const VoxelBox addresses = Brick::over(cells);
  if (addresses.size() <= bricks_.size()) {
    for_each_cell(addresses, [&](const VoxelIndex& address) {
      if (const Brick* brick = find_brick(address)) {
        add_brick(address, *brick);
      }
    });
  } else {
    for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
      if (addresses.contains(address)) {
        add_brick(address, brick);
      }
    });
  }
  if (known == 0) {
    return std::nullopt;
  }
  return policy == CoarseningPolicy::Max ? largest * step_
                                         : static_cast<double>(sum) / static_cast<double>(known) * step_;
}

VANTAGE_INLINE Occupancy OccupancyMap::at(const VoxelIndex& coarse, int level, CoarseningPolicy policy) const {
  const std::optional<double> value = log_odds(coarse, level, policy);
  if (!value) {
    return Occupancy::Unknown;
  }
  return *value >= 0.0 ? Occupancy::Occupied : Occupancy::Free;
}

VANTAGE_INLINE OccupancyMap::Counts OccupancyMap::counts() const {
  Counts counts;
  for_each_brick([&](const VoxelIndex&, const Brick& brick) {
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      counts.free += detail::bits_in(brick.free(word));
      counts.occupied += detail::bits_in(brick.occupied[word]);
    }
  });
  return counts;
}

VANTAGE_INLINE OccupancyMap& OccupancyMap::operator=(const OccupancyMap& other) {
  OccupancyMap copy(other);
  swap(copy);
  return *this;
}

// The moved-from map gets a new identity, which allocates memory and may throw.
// NOLINTNEXTLINE(performance-noexcept-move-constructor)
VANTAGE_INLINE OccupancyMap::OccupancyMap(OccupancyMap&& other) : OccupancyMap(other.options_) { swap(other); }

// NOLINTNEXTLINE(performance-noexcept-move-constructor)
VANTAGE_INLINE OccupancyMap& OccupancyMap::operator=(OccupancyMap&& other) {
  OccupancyMap taken(std::move(other));
  swap(taken);
  return *this;
}

VANTAGE_INLINE void OccupancyMap::swap(OccupancyMap& other) {
  std::swap(identity_, other.identity_);
  std::swap(options_, other.options_);
  std::swap(frame_, other.frame_);
  std::swap(region_, other.region_);
  std::swap(step_, other.step_);
  std::swap(hit_steps_, other.hit_steps_);
  std::swap(miss_steps_, other.miss_steps_);
  std::swap(min_steps_, other.min_steps_);
  std::swap(max_steps_, other.max_steps_);
  std::swap(directory_, other.directory_);
  bricks_.swap(other.bricks_);
  std::swap(entries_, other.entries_);
  std::swap(bounds_, other.bounds_);
  std::swap(may_have_shrunk_, other.may_have_shrunk_);
  std::swap(written_, other.written_);
  std::swap(cells_refused_, other.cells_refused_);
  std::swap(revision_, other.revision_);
  std::swap(newest_, other.newest_);
}

VANTAGE_INLINE std::size_t OccupancyMap::memory_bytes() const {
  return sizeof(*this) + directory_.memory_bytes() + bricks_.size() * (kBytesOfEntry + sizeof(Brick));
}

VANTAGE_INLINE std::size_t OccupancyMap::resident_bytes() const {
  return sizeof(*this) + directory_.memory_bytes() + bricks_.size() * kBytesOfEntry + bricks_.resident_bytes();
}

VANTAGE_INLINE void OccupancyMap::require_past(Revision revision) const {
  if (revision > revision_) {
    throw std::invalid_argument("changed_since(" + std::to_string(revision) + "): the map is only at revision " +
                                std::to_string(revision_));
  }
}

VANTAGE_INLINE std::vector<VoxelIndex> OccupancyMap::changed_since(Revision revision) const {
  std::vector<VoxelIndex> changed;
  for_each_changed_since(revision,
                         [&](const VoxelIndex& address, const Brick& /*brick*/) { changed.push_back(address); });
  return changed;
}

VANTAGE_INLINE void OccupancyMap::require_addressable(const VoxelIndex& cell, const char* what) {
  if (!is_addressable(cell)) {
    throw std::invalid_argument(std::string(what) + ": cell (" + std::to_string(cell.x) + ", " +
                                std::to_string(cell.y) + ", " + std::to_string(cell.z) +
                                ") cannot be addressed, must be within " + std::to_string(kFurthestVoxel) +
                                " on each axis");
  }
}

// The part of a box inside the region. Throws if it is not addressable or too large.
VANTAGE_INLINE VoxelBox OccupancyMap::writable(const VoxelBox& cells, const char* what) const {
  const VoxelBox inside = region_ ? detail::box_overlap(cells, *region_) : cells;
  if (inside.empty()) {
    return {};
  }
  require_addressable(inside.lo, what);
  require_addressable(inside.hi - VoxelIndex{1, 1, 1}, what);
  const VoxelIndex extent = inside.extent();
  if (const double count = 1.0 * extent.x * extent.y * extent.z; count > static_cast<double>(kMaxBoxCells)) {
    detail::require_option(false, std::string(what) + ": count of cells", count,
                           "at most OccupancyMap::kMaxBoxCells (1073741824)");
  }
  return inside;
}

VANTAGE_INLINE void OccupancyMap::set(const VoxelIndex& cell, Occupancy occupancy) {
  require_addressable(cell, "OccupancyMap::set");
  if (!in_region(cell)) {
    return;
  }
  ++revision_;
  const std::int8_t steps = occupancy == Occupancy::Unknown ? std::int8_t{0}
                            : occupancy == Occupancy::Free  ? min_steps_
                                                            : max_steps_;
  write(cell, occupancy, steps);
}

VANTAGE_INLINE void OccupancyMap::set_log_odds(const VoxelBox& cells, double log_odds) {
  if (std::isnan(log_odds)) {
    throw std::invalid_argument("set_log_odds: the log-odds must be a number");
  }
  const VoxelBox inside = writable(cells, "OccupancyMap::set_log_odds");
  if (inside.empty()) {
    return;
  }
  begin_revision();
  const std::int8_t steps = to_steps(log_odds);
  const Occupancy state = steps >= 0 ? Occupancy::Occupied : Occupancy::Free;
  for_each_cell(inside, [&](const VoxelIndex& cell) { write(cell, state, steps); });
}

VANTAGE_INLINE void OccupancyMap::assume_free(const Box& box) {
  if (box.empty() || !frame_.addressable(box.min) || !frame_.addressable(box.max)) {
    throw std::invalid_argument("assume_free: the box must have min < max on every axis and be within the map");
  }
  const VoxelBox inside = writable(frame_.cells_touched_by(box), "OccupancyMap::assume_free");
  begin_revision();
  for_each_cell(inside, [&](const VoxelIndex& cell) {
    if (at(cell) == Occupancy::Unknown) {
      write(cell, Occupancy::Free, miss_steps_);
    }
  });
}

// Begins a revision that writes many cells. `set` does not, because a search of the bounds would dominate its cost.
VANTAGE_INLINE void OccupancyMap::begin_revision() {
  ++revision_;
  bricks_.release_read();
  if (std::exchange(may_have_shrunk_, false)) {
    bounds_ = box_of_known();
  }
}

VANTAGE_INLINE BrickDirectory::Number OccupancyMap::brick_for(const VoxelIndex& address) {
  const BrickDirectory::Number known = directory_.find(address);
  if (known != BrickDirectory::kNone) {
    return known;
  }
  if (options_.max_bytes != 0) {
    const std::size_t bricks = (bricks_.size() + 1) * (kBytesOfEntry + sizeof(Brick));
    if (sizeof(*this) + directory_.memory_with(address) + bricks > options_.max_bytes) {
      return BrickDirectory::kNone;
    }
  }
  const auto number = static_cast<BrickDirectory::Number>(bricks_.size());
  if (!bricks_.add()) {
    return BrickDirectory::kNone;
  }
  directory_.place(address) = number;
  entries_.emplace_back().address = address;
  written_.push_back(revision_);
  return number;
}

// All bricks form a doubly linked list, ordered by the revision of their last change. A changed brick moves to the
// head. So the list holds each brick once, and a reader visits only the bricks that are new to it.
VANTAGE_INLINE void OccupancyMap::mark_changed(BrickDirectory::Number number) {
  Entry& entry = entries_[number];
  if (entry.changed == revision_) {
    return;
  }
  if (newest_ != number) {
    if (entry.newer != BrickDirectory::kNone) {
      entries_[entry.newer].older = entry.older;
    }
    if (entry.older != BrickDirectory::kNone) {
      entries_[entry.older].newer = entry.newer;
    }
    entry.newer = BrickDirectory::kNone;
    entry.older = newest_;
    if (newest_ != BrickDirectory::kNone) {
      entries_[newest_].newer = number;
    }
    newest_ = number;
  }
  entry.changed = revision_;
}

VANTAGE_INLINE void OccupancyMap::write(const VoxelIndex& cell, Occupancy state, std::int8_t steps) {
  const VoxelIndex address = Brick::of_cell(cell);
  if (state == Occupancy::Unknown && directory_.find(address) == BrickDirectory::kNone) {
    return;
  }
  const BrickDirectory::Number number = brick_for(address);
  if (number == BrickDirectory::kNone) {
    ++cells_refused_;
    return;
  }
  Brick& brick = writing(number);
  const std::size_t offset = Brick::offset_of(cell);
  const std::uint64_t bit = std::uint64_t{1} << (offset & 63U);
  const std::size_t word = offset >> 6U;
  if (brick.at(offset) != state) {
    mark_changed(number);
    const VoxelBox inner = bounds_.grown(-1);
    if (state == Occupancy::Unknown) {
      may_have_shrunk_ = may_have_shrunk_ || !inner.contains(cell);
    } else if (!inner.contains(cell)) {
      grow_bounds({cell, cell + VoxelIndex{1, 1, 1}});
    }
  }
  brick.known[word] = state == Occupancy::Unknown ? brick.known[word] & ~bit : brick.known[word] | bit;
  brick.occupied[word] = state == Occupancy::Occupied ? brick.occupied[word] | bit : brick.occupied[word] & ~bit;
  brick.log_odds[offset] = steps;
}

VANTAGE_INLINE std::int8_t OccupancyMap::to_steps(double log_odds) const {
  const auto steps =
      static_cast<std::int8_t>(std::clamp<double>(std::round(log_odds / step_), min_steps_, max_steps_));
  // a negative value must not round to 0, which is occupied
  return log_odds < 0.0 ? std::min(steps, std::int8_t{-1}) : steps;
}

}  // namespace vantage
