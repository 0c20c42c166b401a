// SPDX-License-Identifier: MIT
// Any sequence of operations on a map, beside a slow model: one number for each known cell.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan_cells.hpp>

#include "fuzz_target.hpp"
#include "input_bytes.hpp"

namespace {

using vantage::Occupancy;
using vantage::OccupancyMap;
using vantage::VoxelBox;
using vantage::VoxelIndex;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// Log-odds by cell, in steps of 0.05: the default options.
class Model {
 public:
  void set(const VoxelIndex& cell, Occupancy state) {
    if (state == Occupancy::Unknown) {
      cells_.erase(cell);
    } else {
      cells_[cell] = state == Occupancy::Free ? kMin : kMax;
    }
  }
  void set_log_odds(const VoxelBox& box, int steps) {
    for_each_cell(box, [&](const VoxelIndex& cell) { cells_[cell] = std::clamp(steps, kMin, kMax); });
  }
  void assume_free(const VoxelBox& box) {
    for_each_cell(box, [&](const VoxelIndex& cell) { cells_.try_emplace(cell, kMiss); });
  }
  void insert(const vantage::ScanCells& scan) {
    for (const VoxelIndex& cell : scan.hit) {
      cells_[cell] = std::min(cells_[cell] + kHit, kMax);
    }
    for (const VoxelIndex& cell : scan.cleared) {
      cells_[cell] = std::max(cells_[cell] + kMiss, kMin);
    }
  }
  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const {
    const auto found = cells_.find(cell);
    return found == cells_.end() ? Occupancy::Unknown : found->second >= 0 ? Occupancy::Occupied : Occupancy::Free;
  }
  [[nodiscard]] const std::map<VoxelIndex, int>& cells() const { return cells_; }

 private:
  static constexpr int kHit = 17;
  static constexpr int kMiss = -8;
  static constexpr int kMin = -40;
  static constexpr int kMax = 70;
  std::map<VoxelIndex, int> cells_;
};

// A limited map may lack cells; what it holds is right while it has refused nothing.
void compare(const OccupancyMap& map, const Model& model) {
  VoxelBox bounds;
  for (const auto& [cell, steps] : model.cells()) {
    const auto held = map.log_odds(cell);
    require(held.has_value() && std::abs(*held - 0.05 * steps) < 1e-9);
    const VoxelIndex above = cell + VoxelIndex{1, 1, 1};
    bounds =
        bounds.empty()
            ? VoxelBox{cell, above}
            : VoxelBox{
                  {std::min(bounds.lo.x, cell.x), std::min(bounds.lo.y, cell.y), std::min(bounds.lo.z, cell.z)},
                  {std::max(bounds.hi.x, above.x), std::max(bounds.hi.y, above.y), std::max(bounds.hi.z, above.z)}};
  }
  require(map.counts().free + map.counts().occupied == model.cells().size());
  require(bounds.empty() ? map.bounds().empty() : map.bounds() == bounds);
}

vantage::Scan scan_from(vantage::fuzz::InputBytes& input) {
  vantage::Scan scan;
  const auto metres = [&] { return 0.03 * input.small() + 0.001; };
  scan.world_from_sensor = vantage::pose_looking({metres(), metres(), metres()}, metres());
  scan.max_range_m = 0.5 + 0.02 * input.byte();
  for (int i = input.byte() % 6; i >= 0; --i) {
    const Eigen::Vector3d point(metres(), metres(), metres());
    (i % 4 == 3 ? scan.no_return : scan.points).push_back(point.cast<float>());
  }
  return scan;
}

}  // namespace

std::vector<std::string> vantage::fuzz::seeds() { return random_seeds(200); }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vantage::fuzz::InputBytes input(data, std::min<std::size_t>(size, 400));
  const std::size_t max_bytes = input.byte() % 2 == 0 ? 0 : 3000 + 200 * std::size_t{input.byte()};
  OccupancyMap map({.max_bytes = max_bytes});
  Model model;
  const auto cell = [&] { return VoxelIndex{input.small(), input.small(), input.small() / 4}; };
  const auto box = [&] {
    const VoxelIndex lo = cell();
    const std::uint8_t extent = input.byte();
    return VoxelBox{lo, lo + VoxelIndex{1 + extent % 8, 1 + extent / 8 % 8, 1 + extent / 64}};
  };
  while (!input.empty()) {
    const OccupancyMap::Revision before = map.revision();
    const Model old = model;
    switch (input.byte() % 9) {
      case 0: {
        const VoxelIndex at = cell();
        const auto state = static_cast<Occupancy>(input.byte() % 3);
        map.set(at, state);
        model.set(at, state);
        break;
      }
      case 1: {
        const VoxelBox cells = box();
        const int steps = input.small();
        map.set_log_odds(cells, 0.05 * steps);
        model.set_log_odds(cells, steps);
        break;
      }
      case 2: {
        const VoxelBox cells = box();
        const vantage::Box metres = map.frame().box_of(cells);
        const Eigen::Vector3d within = Eigen::Vector3d::Constant(0.02);
        map.assume_free({metres.min + within, metres.max - within});
        model.assume_free(cells);
        break;
      }
      case 3:
      case 4: {
        const vantage::Scan scan = scan_from(input);
        model.insert(scan_cells(scan, map));
        map.insert(scan);
        break;
      }
      case 5: {
        const OccupancyMap copy = map;
        require(copy.revision() == map.revision());
        map = copy;
        break;
      }
      case 6: {
        OccupancyMap taken = std::move(map);
        require(map.revision() == 0 && map.bounds().empty());  // NOLINT(bugprone-use-after-move): it is an empty map
        map.swap(taken);
        break;
      }
      case 7: {
        const VoxelIndex brick = vantage::Brick::of_cell(cell());
        vantage::Brick cells;
        for (std::size_t word = 0; word < vantage::Brick::kWords; ++word) {
          cells.known[word] = 0x0101010101010101U * input.byte();
          cells.occupied[word] = cells.known[word] & 0x00FF00FF00FF00FFU;
        }
        map.assign(brick, cells.known, cells.occupied);
        for (std::size_t offset = 0; offset < vantage::Brick::kCells; ++offset) {
          model.set(vantage::Brick::cell_at(brick, offset), cells.at(offset));
        }
        break;
      }
      default:
        map.confirm();
    }
    require(map.revision() >= before && (max_bytes == 0 || map.memory_bytes() <= max_bytes));
    if (map.cells_refused() > 0) {
      require(max_bytes > 0);
      continue;  // the model has no limit
    }
    std::set<VoxelIndex> changed;
    const auto note = [&](const auto& entry) {
      if (old.at(entry.first) != model.at(entry.first)) {
        changed.insert(vantage::Brick::of_cell(entry.first));
      }
    };
    std::for_each(model.cells().begin(), model.cells().end(), note);
    std::for_each(old.cells().begin(), old.cells().end(), note);
    const std::vector<VoxelIndex> told = map.changed_since(before);
    require(std::set<VoxelIndex>(told.begin(), told.end()) == changed);
    compare(map, model);
  }
  return 0;
}
