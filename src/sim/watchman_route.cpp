// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/sim/watchman_route.hpp>

#include <vantage/raytrace/impl/shared_work.hpp>
#include <vantage/settings/impl/option_rule.hpp>
#include "sim/shortest_visit.hpp"
#include "sim/sight.hpp"

namespace vantage {
namespace {

// Number of unseen cells, evenly spread in raster order, among which the next witness is chosen.
constexpr std::size_t kTriedWitnesses = 24;

class Watchman {
 public:
  Watchman(const Truth& truth, const Platform& platform, const RangeSensor& sensor, const Pose& start,
           const WatchmanOptions& options)
      : threads_(static_cast<std::size_t>(options.threads)),
        stop_(options.stop),
        space_(ReachableSpace(truth.map(), platform, start)),
        graph_(space_),
        sight_(truth.cells(), truth.map().frame(), sensor, platform.can_tilt()) {
    if (space_.size() == 0) {
      throw std::invalid_argument("watchman_route: the platform cannot be at the start");
    }
    cells_ = truth.observable(platform, sensor, start, options.threads);
    member_.assign(space_.size(), 0);
  }

  WatchmanRoute run(const WatchmanOptions& options) {
    WatchmanRoute route;
    Visit visit{{0}, 0.0};
    std::vector<std::size_t> unseen = unseen_from(visit);
    while (!unseen.empty() && route.witnesses.size() < options.max_witnesses) {
      const std::optional<VoxelIndex> witness = hardest(unseen, visit);
      if (!witness) {
        break;
      }
      add_set(*witness, route.witnesses.size());
      route.witnesses.push_back(*witness);
      if (stopped()) {
        break;
      }
      visit = shortest_visit(graph_, member_, route.witnesses.size());
      unseen = unseen_from(visit);
    }
    route.length_m = visit.length * sight_.frame().size_m;
    route.sees_all = unseen.empty();
    route.seen = cells_.empty() ? 1.0 : 1.0 - static_cast<double>(unseen.size()) / static_cast<double>(cells_.size());
    for (const std::uint32_t cell : visit.cells) {
      route.cells.push_back(space_.cells()[cell]);
    }
    return route;
  }

 private:
  [[nodiscard]] bool stopped() const { return stop_ && stop_(); }

  // The observable cells that the sensor sees from no place of the route. Centres are tested first along the whole
  // route, because that suffices for most cells.
  std::vector<std::size_t> unseen_from(const Visit& visit) const {
    std::vector<std::uint8_t> seen(cells_.size(), 0);
    detail::share_work(cells_.size(), threads_, [&](std::size_t i) {
      if (stopped()) {
        return;
      }
      const auto from_one = [&](auto&& sees) {
        return std::any_of(visit.cells.begin(), visit.cells.end(),
                           [&](std::uint32_t from) { return sees(space_.cells()[from]); });
      };
      seen[i] = from_one([&](const VoxelIndex& from) { return sight_.sees(from, cells_[i]); }) ||
                        from_one([&](const VoxelIndex& from) { return sight_.sees_part(from, cells_[i]); })
                    ? 1
                    : 0;
    });
    std::vector<std::size_t> unseen;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (seen[i] == 0) {
        unseen.push_back(i);
      }
    }
    return unseen;
  }

  // Among some of the unseen cells, the one whose nearest viewing place is furthest from the route; none if no
  // place sees any of them.
  std::optional<VoxelIndex> hardest(const std::vector<std::size_t>& unseen, const Visit& visit) const {
    const std::vector<float> distance = distances_from(graph_, visit.cells);
    std::vector<std::uint32_t> nearest_first(space_.size());
    std::iota(nearest_first.begin(), nearest_first.end(), 0U);
    std::stable_sort(nearest_first.begin(), nearest_first.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return distance[a] < distance[b]; });
    const std::size_t tried = std::min(unseen.size(), kTriedWitnesses);
    std::vector<float> detour(tried, -1.0F);
    const auto candidate = [&](std::size_t i) { return cells_[unseen[i * unseen.size() / tried]]; };
    detail::share_work(tried, threads_, [&](std::size_t i) {
      const auto from = std::find_if(nearest_first.begin(), nearest_first.end(), [&](std::uint32_t place) {
        return !stopped() && sight_.sees_part(space_.cells()[place], candidate(i));
      });
      detour[i] = from == nearest_first.end() ? -1.0F : distance[*from];
    });
    const auto furthest = std::max_element(detour.begin(), detour.end());
    if (*furthest < 0.0F) {
      return std::nullopt;
    }
    return candidate(static_cast<std::size_t>(furthest - detour.begin()));
  }

  void add_set(const VoxelIndex& witness, std::size_t set) {
    detail::share_work(space_.size(), threads_, [&](std::size_t place) {
      const bool sees = !stopped() && sight_.sees_part(space_.cells()[place], witness);
      member_[place] = static_cast<std::uint16_t>(member_[place] | (sees ? 1U << set : 0U));
    });
  }

  std::size_t threads_;
  std::function<bool()> stop_;
  NumberedCells space_;
  StepGraph graph_;
  Sight sight_;
  std::vector<VoxelIndex> cells_;
  std::vector<std::uint16_t> member_;  // for each place, the witnesses that it sees
};

}  // namespace

WatchmanRoute watchman_route(const Truth& truth, const Platform& platform, const RangeSensor& sensor,
                             const Pose& start, const WatchmanOptions& options) {
  sensor.validate();
  detail::require_option(options.max_witnesses >= 1 && options.max_witnesses <= 12, "WatchmanOptions: max_witnesses",
                         options.max_witnesses, "in [1, 12]");
  detail::require_option(options.threads > 0, "WatchmanOptions: threads", options.threads, "> 0");
  return Watchman(truth, platform, sensor, start, options).run(options);
}

}  // namespace vantage
