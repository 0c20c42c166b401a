// SPDX-License-Identifier: MIT
#include "evaluation/zones.hpp"

#include <algorithm>
#include <array>
#include <queue>
#include <utility>

#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage::detail {
namespace {

constexpr double kUnknownCounts = 2.0;

}  // namespace

Zones::Zones(const VoxelFrame& frame, const VoxelBox& box, std::int32_t side,
             const std::function<ZoneKind(const VoxelIndex&)>& kind_of)
    : numbers_(box, 0U) {
  VoxelGrid<std::uint8_t> kinds(box, 0U);
  for_each_cell(box, [&](const VoxelIndex& cell) { kinds[cell] = static_cast<std::uint8_t>(kind_of(cell)); });
  const auto block_of = [&](const VoxelIndex& cell) {
    return VoxelIndex{(cell.x - box.lo.x) / side, (cell.y - box.lo.y) / side, (cell.z - box.lo.z) / side};
  };
  std::vector<VoxelIndex> flood;
  for_each_cell(box, [&](const VoxelIndex& seed) {
    if (kinds[seed] == 0 || numbers_[seed] != 0) {
      return;
    }
    zones_.push_back({.kind = static_cast<ZoneKind>(kinds[seed])});
    Zone& zone = zones_.back();
    const auto number = static_cast<std::uint32_t>(zones_.size());
    const VoxelIndex block = block_of(seed);
    flood.assign(1, seed);
    numbers_[seed] = number;
    for (std::size_t next = 0; next < flood.size(); ++next) {
      const VoxelIndex cell = flood[next];
      zone.centre_m += frame.centre_of(cell);
      for (const VoxelIndex& by : kFaceNeighbours) {
        const VoxelIndex to = cell + by;
        if (box.contains(to) && kinds[to] == kinds[seed] && numbers_[to] == 0 && block_of(to) == block) {
          numbers_[to] = number;
          flood.push_back(to);
        }
      }
    }
    zone.cells = flood.size();
    zone.centre_m /= static_cast<double>(zone.cells);
  });
  for_each_cell(box, [&](const VoxelIndex& cell) {
    for (const VoxelIndex& by : {VoxelIndex{1, 0, 0}, VoxelIndex{0, 1, 0}, VoxelIndex{0, 0, 1}}) {
      const std::uint32_t a = numbers_[cell];
      const std::uint32_t b = numbers_.value_or(cell + by, 0U);
      if (a != b && a != 0 && b != 0 && (zones_[a - 1].beside.empty() || zones_[a - 1].beside.back() != b - 1)) {
        zones_[a - 1].beside.push_back(b - 1);
        zones_[b - 1].beside.push_back(a - 1);
      }
    }
  });
  for (Zone& zone : zones_) {
    std::sort(zone.beside.begin(), zone.beside.end());
    zone.beside.erase(std::unique(zone.beside.begin(), zone.beside.end()), zone.beside.end());
  }
}

std::size_t Zones::zone_of(const VoxelIndex& cell) const {
  const std::uint32_t number = numbers_.value_or(cell, 0U);
  return number == 0 ? kNone : number - 1;
}

std::vector<double> Zones::lengths_from(std::size_t zone) const {
  std::vector<double> lengths(zones_.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
  lengths[zone] = 0.0;
  waiting.emplace(0.0, zone);
  while (!waiting.empty()) {
    const auto [length, at] = waiting.top();
    waiting.pop();
    if (length > lengths[at]) {
      continue;
    }
    for (const std::size_t to : zones_[at].beside) {
      const bool is_free = zones_[at].kind == ZoneKind::Free && zones_[to].kind == ZoneKind::Free;
      const double step = (is_free ? 1.0 : kUnknownCounts) * (zones_[at].centre_m - zones_[to].centre_m).norm();
      if (length + step < lengths[to]) {
        lengths[to] = length + step;
        waiting.emplace(lengths[to], to);
      }
    }
  }
  return lengths;
}

}  // namespace vantage::detail
