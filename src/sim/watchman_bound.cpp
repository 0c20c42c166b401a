// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/sim/watchman_bound.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/settings/impl/option_rule.hpp>
#include "sim/pocket_tree.hpp"
#include "sim/pose_plane.hpp"
#include "sim/pose_tree.hpp"
#include "sim/sight.hpp"

namespace vantage {
namespace {

// A witness that deepens the pockets by less, in cells, is not worth the time to find all the places that see it.
constexpr double kLeastGain = 2.5;

class PocketSearch {
 public:
  PocketSearch(const Truth& truth, const Platform& platform, const RangeSensor& sensor, const Pose& start,
               int threads, const std::function<bool()>& stop)
      : stop_(stop),
        space_(reachable(truth, platform, start)),
        graph_(space_),
        pockets_(graph_),
        sight_(truth.cells(), truth.map().frame(), sensor, platform.can_tilt()),
        range_cells_(sensor.max_range_m / truth.map().resolution_m()),
        cells_(truth.observable(platform, sensor, start, threads)) {}

  double run() {
    if (cells_.empty()) {
      return 0.0;
    }
    const VoxelBox box = detail::box_around(cells_);
    const auto is_solid = [this](const VoxelIndex& cell) { return !sight_.is_free(cell); };
    if (detail::PosePlane::holds(space_.cells(), box)) {
      const detail::PosePlane plane(space_.cells(), box, is_solid);
      enter_all([&](const VoxelIndex& cell, const auto& ask) { return plane.any(cell, range_cells_, ask); });
    } else {
      const detail::PoseTree tree(space_.cells());
      enter_all([&](const VoxelIndex& cell, const auto& ask) { return tree.any(cell, range_cells_, is_solid, ask); });
    }
    return pockets_.bound() * sight_.frame().size_m;
  }

 private:
  static NumberedCells reachable(const Truth& truth, const Platform& platform, const Pose& start) {
    NumberedCells space(ReachableSpace(truth.map(), platform, start));
    if (space.size() == 0) {
      throw std::invalid_argument("watchman_bound: the platform cannot be at the start");
    }
    return space;
  }

  // Takes every cell that proves a pocket due. `any(cell, ask)`: whether `ask` is true of a place that may see it.
  // Pockets deep inside come first, because most other cells are then seen from pockets that are due already.
  template <class Any>
  void enter_all(const Any& any) {
    for (const std::size_t i : deepest_first(any)) {
      const VoxelIndex& cell = cells_[i];
      if (stop_ && stop_()) {
        return;
      }
      const bool seen_anyway =
          std::any_of(recent_.begin(), recent_.end(), [&](std::uint32_t place) { return sees(place, cell); }) ||
          any(cell,
              [&](const VoxelIndex& at) { return pockets_.is_due(space_.number_of(at)) && sight_.sees(at, cell); });
      if (!seen_anyway && may_gain(any, cell)) {
        enter(cell);
      }
    }
  }

  // By the depth of the first place that sees the cell.
  template <class Any>
  std::vector<std::size_t> deepest_first(const Any& any) const {
    std::vector<float> depth(cells_.size(), 0.0F);
    for (std::size_t i = 0; i < cells_.size() && !(stop_ && stop_()); ++i) {
      any(cells_[i], [&](const VoxelIndex& at) {
        depth[i] = pockets_.depth(space_.number_of(at));
        return sight_.sees(at, cells_[i]);
      });
    }
    std::vector<std::size_t> order(cells_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
    return order;
  }

  // Tested with the places that see its centre: the others can only make the pocket larger.
  template <class Any>
  bool may_gain(const Any& any, const VoxelIndex& cell) const {
    std::vector<std::uint32_t> places;
    any(cell, [&](const VoxelIndex& at) {
      if (sight_.sees(at, cell)) {
        places.push_back(space_.number_of(at));
      }
      return false;
    });
    return !places.empty() && pockets_.gain(pockets_.pocket_of(places)) >= kLeastGain;
  }

  [[nodiscard]] bool sees(std::uint32_t place, const VoxelIndex& cell) const {
    const VoxelIndex by = space_.cells()[place] - cell;
    const double furthest = range_cells_ + 1.0;  // to a part of the cell
    return static_cast<double>(by.x) * by.x + static_cast<double>(by.y) * by.y + static_cast<double>(by.z) * by.z <=
               furthest * furthest &&
           sight_.sees_part(space_.cells()[place], cell);
  }

  void enter(const VoxelIndex& witness) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t place = 0; place < space_.size(); ++place) {
      if (!sees(place, witness)) {
        continue;
      }
      if (pockets_.is_due(place)) {
        recent_[next_recent_++ % recent_.size()] = place;  // cells near this one are often seen from there, too
        return;
      }
      places.push_back(place);
    }
    if (!places.empty()) {
      pockets_.make_due(pockets_.pocket_of(places));
    }
  }

  std::function<bool()> stop_;
  NumberedCells space_;
  StepGraph graph_;
  PocketTree pockets_;
  Sight sight_;
  double range_cells_;
  std::vector<VoxelIndex> cells_;
  std::array<std::uint32_t, 64> recent_{};  // due places that have lately seen a cell
  std::size_t next_recent_ = 0;
};

}  // namespace

double watchman_bound(const Truth& truth, const Platform& platform, const RangeSensor& sensor, const Pose& start,
                      int threads, const std::function<bool()>& stop) {
  sensor.validate();
  detail::require_option(threads > 0, "watchman_bound: threads", threads, "> 0");
  return PocketSearch(truth, platform, sensor, start, threads, stop).run();
}

}  // namespace vantage
