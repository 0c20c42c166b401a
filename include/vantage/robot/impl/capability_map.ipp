// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vantage/robot/capability_map.hpp>

#include <vantage/geometry/impl/dice.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline constexpr double kQuarter = 0.25 * std::numbers::pi;

inline void validate(const CapabilityMapOptions& options, std::span<const JointRange> ranges) {
  detail::require_option(std::isfinite(options.cell_m) && options.cell_m > 0.0, "CapabilityMapOptions::cell_m",
                         options.cell_m, "> 0");
  detail::require_option(options.direction_bins_per_edge >= 1 && options.direction_bins_per_edge <= 32,
                         "CapabilityMapOptions::direction_bins_per_edge", options.direction_bins_per_edge,
                         "in [1, 32]");
  detail::require_option(options.samples > 0, "CapabilityMapOptions::samples", options.samples, "> 0");
  if (ranges.empty()) {
    throw std::invalid_argument("CapabilityMap needs at least one joint");
  }
  for (const JointRange& range : ranges) {
    detail::require_option(std::isfinite(range.min) && std::isfinite(range.max) && range.min <= range.max,
                           "JointRange::min", range.min, "finite and <= max");
  }
}

inline std::size_t offset_in(const VoxelBox& box, const VoxelIndex& cell) {
  const VoxelIndex from_lo = cell - box.lo;
  const VoxelIndex extent = box.extent();
  return (static_cast<std::size_t>(from_lo.z) * static_cast<std::size_t>(extent.y) +
          static_cast<std::size_t>(from_lo.y)) *
             static_cast<std::size_t>(extent.x) +
         static_cast<std::size_t>(from_lo.x);
}

// The bounding box of the cells.
inline VoxelBox box_around(const std::vector<std::pair<VoxelIndex, std::size_t>>& drawn) {
  VoxelBox box{drawn.front().first, drawn.front().first};
  for (const auto& [cell, bin] : drawn) {
    box.lo = {std::min(box.lo.x, cell.x), std::min(box.lo.y, cell.y), std::min(box.lo.z, cell.z)};
    box.hi = {std::max(box.hi.x, cell.x), std::max(box.hi.y, cell.y), std::max(box.hi.z, cell.z)};
  }
  return {box.lo, box.hi + VoxelIndex{1, 1, 1}};
}

}  // namespace detail

VANTAGE_INLINE CapabilityMap::CapabilityMap(const ForwardKinematics& forward, std::span<const JointRange> ranges,
                                            const CapabilityMapOptions& options)
    : options_(options) {
  detail::validate(options, ranges);
  detail::Dice dice(options.seed);
  std::vector<double> joints(ranges.size());
  std::vector<std::pair<VoxelIndex, std::size_t>> drawn;
  for (std::size_t sample = 0; sample < options.samples; ++sample) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      joints[i] = ranges[i].min + dice.share() * (ranges[i].max - ranges[i].min);
    }
    if (const std::optional<Pose> base_from_sensor = forward(joints)) {
      drawn.emplace_back(frame().cell_of(base_from_sensor->translation()), bin_of(optical_axis(*base_from_sensor)));
    }
  }
  if (drawn.empty()) {
    throw std::invalid_argument("CapabilityMap: none of the configurations drawn can be taken");
  }
  cells_ = detail::box_around(drawn);
  bits_.resize(cells_.size() * words_per_cell());
  for (const auto& [cell, bin] : drawn) {
    bits_[detail::offset_in(cells_, cell) * words_per_cell() + bin / 64] |= std::uint64_t{1} << bin % 64;
  }
}

VANTAGE_INLINE std::size_t CapabilityMap::bin_count() const {
  const auto edge = static_cast<std::size_t>(options_.direction_bins_per_edge);
  return 6 * edge * edge;
}

// Two faces per axis, the negative one first; equal angles along each edge of a face.
VANTAGE_INLINE std::size_t CapabilityMap::bin_of(const Eigen::Vector3d& direction) const {
  Eigen::Index axis = 0;
  const double most = direction.cwiseAbs().maxCoeff(&axis);
  const auto edge = static_cast<std::size_t>(options_.direction_bins_per_edge);
  const auto step_along = [&](Eigen::Index across) {
    const double share = 0.5 + 0.5 * std::atan(direction[across] / most) / detail::kQuarter;
    return std::min(static_cast<std::size_t>(share * static_cast<double>(edge)), edge - 1);
  };
  const std::size_t side = 2 * static_cast<std::size_t>(axis) + (direction[axis] > 0.0 ? 1 : 0);
  return (side * edge + step_along((axis + 2) % 3)) * edge + step_along((axis + 1) % 3);
}

VANTAGE_INLINE Eigen::Vector3d CapabilityMap::middle_of(std::size_t bin) const {
  const auto edge = static_cast<std::size_t>(options_.direction_bins_per_edge);
  const auto along = [&](std::size_t step) {
    return std::tan(detail::kQuarter * (2.0 * (static_cast<double>(step) + 0.5) / static_cast<double>(edge) - 1.0));
  };
  const std::size_t side = bin / (edge * edge);
  const auto axis = static_cast<Eigen::Index>(side / 2);
  Eigen::Vector3d direction;
  direction[axis] = side % 2 == 1 ? 1.0 : -1.0;
  direction[(axis + 1) % 3] = along(bin % edge);
  direction[(axis + 2) % 3] = along(bin / edge % edge);
  return direction.normalized();
}

VANTAGE_INLINE std::span<const std::uint64_t> CapabilityMap::words_of(const VoxelIndex& cell) const {
  if (!cells_.contains(cell)) {
    return {};
  }
  return std::span(bits_).subspan(detail::offset_in(cells_, cell) * words_per_cell(), words_per_cell());
}

VANTAGE_INLINE bool CapabilityMap::contains(const Eigen::Vector3d& position_m,
                                            const Eigen::Vector3d& direction) const {
  if (!frame().addressable(position_m) || !direction.allFinite() || direction.isZero(0.0)) {
    return false;
  }
  const std::span<const std::uint64_t> words = words_of(frame().cell_of(position_m));
  const std::size_t bin = bin_of(direction);
  return !words.empty() && (words[bin / 64] >> bin % 64 & 1U) != 0;
}

VANTAGE_INLINE std::size_t CapabilityMap::directions_in(const VoxelIndex& cell) const {
  std::size_t count = 0;
  for (const std::uint64_t word : words_of(cell)) {
    count += static_cast<std::size_t>(std::popcount(word));
  }
  return count;
}

VANTAGE_INLINE std::vector<Eigen::Vector3d> CapabilityMap::directions_at(const VoxelIndex& cell) const {
  std::vector<Eigen::Vector3d> directions;
  const std::span<const std::uint64_t> words = words_of(cell);
  for (std::size_t bin = 0; bin < bin_count() && !words.empty(); ++bin) {
    if ((words[bin / 64] >> bin % 64 & 1U) != 0) {
      directions.push_back(middle_of(bin));
    }
  }
  return directions;
}

VANTAGE_INLINE std::size_t CapabilityMap::reachable_cells() const {
  std::size_t count = 0;
  for_each_cell(cells_, [&](const VoxelIndex& cell) { count += contains(cell) ? 1U : 0U; });
  return count;
}

VANTAGE_INLINE bool CapabilityMap::operator==(const CapabilityMap& other) const {
  const auto options = [](const CapabilityMapOptions& o) {
    return std::tie(o.cell_m, o.direction_bins_per_edge, o.samples, o.seed);
  };
  return options(options_) == options(other.options_) && cells_ == other.cells_ && bits_ == other.bits_;
}

}  // namespace vantage
