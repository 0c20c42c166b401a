// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vantage/evaluation/recorded_views.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/raytrace/following_caster.hpp>
#include <vector>

namespace vantage {
namespace {

double gap_m(const Pose& a, const Pose& b, double metres_per_radian) {
  const double angle = Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
  return (a.translation() - b.translation()).norm() + metres_per_radian * std::abs(angle);
}

// The cells that count: those of the object, or a box that contains all views.
VoxelBox cells_that_count(const RecordedViews& views, const VoxelFrame& frame, double range_m) {
  Box box;
  for (const Scan& scan : views.scans()) {
    box.extend(scan.world_from_sensor.translation() + Eigen::Vector3d::Constant(range_m));
    box.extend(scan.world_from_sensor.translation() - Eigen::Vector3d::Constant(range_m));
  }
  box = views.object().value_or(box);
  return {frame.cell_of(box.min), frame.cell_of(box.max) + VoxelIndex{1, 1, 1}};
}

// Ranges of the returns so far: the share that came from beyond a distance.
class RangeShares {
 public:
  RangeShares(double cell_m, double range_m)
      : cell_m_(cell_m), counts_(static_cast<std::size_t>(std::ceil(range_m / cell_m)) + 2, 0.0) {}

  void add(const Scan& scan) {
    for (const Eigen::Vector3f& point : scan.points) {
      if (point.allFinite()) {
        counts_[bin(static_cast<double>(point.norm()))] += 1.0;
      }
    }
    beyond_ = counts_;
    for (std::size_t i = beyond_.size() - 1; i-- > 0;) {
      beyond_[i] += beyond_[i + 1];
    }
  }
  [[nodiscard]] double beyond(double range_m) const { return beyond_[bin(range_m)] + 1e-9; }

 private:
  [[nodiscard]] std::size_t bin(double range_m) const {
    return std::min(static_cast<std::size_t>(range_m / cell_m_), counts_.size() - 1);
  }

  double cell_m_;
  std::vector<double> counts_;
  std::vector<double> beyond_;
};

// The expected number of cells that a view makes known, and how many of them are marked.
struct ExpectedGain {
  double cells = 0.0;
  double marked = 0.0;
};

// The probability of each cell of a box to become known. Only touched values are cleared.
class Chances {
 public:
  explicit Chances(const VoxelBox& box)
      : box_(box),
        width_(static_cast<std::size_t>(box.hi.x - box.lo.x)),
        depth_(static_cast<std::size_t>(box.hi.y - box.lo.y)),
        chance_(width_ * depth_ * static_cast<std::size_t>(box.hi.z - box.lo.z), 0.0F) {}

  void raise(const VoxelIndex& cell, double chance) {
    if (!box_.contains(cell)) {
      return;
    }
    const std::size_t at = position(cell);
    float& value = chance_[at];
    if (value == 0.0F) {
      touched_.push_back(at);
    }
    value = std::max(value, static_cast<float>(chance));
  }
  /// Marks these cells instead of those marked before.
  void mark(const std::vector<VoxelIndex>& cells) {
    marked_.assign(chance_.size(), false);
    for (const VoxelIndex& cell : cells) {
      if (box_.contains(cell)) {
        marked_[position(cell)] = true;
      }
    }
  }
  /// Sums over all cells and over the marked ones; then sets every value to 0.
  ExpectedGain take_sums() {
    ExpectedGain gain;
    for (const std::size_t position : touched_) {
      const auto chance = static_cast<double>(std::exchange(chance_[position], 0.0F));
      gain.cells += chance;
      gain.marked += !marked_.empty() && marked_[position] ? chance : 0.0;
    }
    touched_.clear();
    return gain;
  }

 private:
  [[nodiscard]] std::size_t position(const VoxelIndex& cell) const {
    const auto x = static_cast<std::size_t>(cell.x - box_.lo.x);
    const auto y = static_cast<std::size_t>(cell.y - box_.lo.y);
    const auto z = static_cast<std::size_t>(cell.z - box_.lo.z);
    return (z * depth_ + y) * width_ + x;
  }

  VoxelBox box_;
  std::size_t width_;
  std::size_t depth_;
  std::vector<float> chance_;
  std::vector<bool> marked_;
  std::vector<std::size_t> touched_;
};

ExpectedGain expected_gain(const OccupancyMap& map, const Pose& pose, const std::vector<Eigen::Vector3f>& directions,
                           double range_m, const RangeShares& shares, Chances& chances) {
  constexpr double kHopeless = 0.02;
  const Eigen::Vector3d from = pose.translation();
  for (const Eigen::Vector3f& direction : directions) {
    const Eigen::Vector3d to = from + range_m * (pose.linear() * direction.cast<double>());
    std::optional<double> began;  // share of the returns from beyond the start of the unknown
    for (const VoxelIndex& cell : VoxelRay(map.frame(), from, to)) {
      const Occupancy state = map.at(cell);
      if (state == Occupancy::Occupied) {
        break;
      }
      if (state == Occupancy::Unknown) {
        const double beyond = shares.beyond((map.frame().centre_of(cell) - from).norm());
        began = began.value_or(beyond);
        if (beyond < kHopeless * *began) {
          break;
        }
        chances.raise(cell, beyond / *began);
      }
    }
  }
  return chances.take_sums();
}

// Expected gains of views. It learns the ranges of the returns from view to view.
class ExpectedGains {
 public:
  ExpectedGains(const RecordedViews& views, const RangeSensor& sensor)
      : views_(&views),
        range_m_(sensor.max_range_m),
        shares_(views.options().resolution_m, sensor.max_range_m),
        directions_(sensor.rays_for(views.options().resolution_m).directions()),
        chances_(cells_that_count(views, VoxelFrame{views.options().resolution_m}, sensor.max_range_m)) {}

  /// Gains of the views `left`, in their order.
  std::vector<ExpectedGain> of(const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left,
                               const std::vector<VoxelIndex>& marked) {
    shares_.add(views_->scans()[last]);
    chances_.mark(marked);
    std::vector<ExpectedGain> gains;
    gains.reserve(left.size());
    for (const std::size_t view : left) {
      const Pose& pose = views_->scans()[view].world_from_sensor;
      gains.push_back(expected_gain(map, pose, directions_, range_m_, shares_, chances_));
    }
    return gains;
  }

 private:
  const RecordedViews* views_;
  double range_m_;
  RangeShares shares_;
  std::vector<Eigen::Vector3f> directions_;
  Chances chances_;
};

// A view is good enough if it shows this share of the sought cells that the best one shows.
constexpr double kEnough = 0.5;

// Index of the gain of the largest worth; of several, the first.
template <class Worth>
std::size_t best_of(std::span<const std::size_t> left, const std::vector<ExpectedGain>& gains, const Worth& worth) {
  const auto best =
      std::max_element(gains.begin(), gains.end(), [&](const auto& a, const auto& b) { return worth(a) < worth(b); });
  return left[static_cast<std::size_t>(best - gains.begin())];
}

}  // namespace

ChooseView most_unknown_cells(const RecordedViews& views, const RangeSensor& sensor, std::size_t threads) {
  const auto looking = std::make_shared<FollowingCaster>();
  return [&views, looking, sensor, threads](const OccupancyMap& map, std::size_t, std::span<const std::size_t> left) {
    looking->follow(map, sensor);
    std::vector<Pose> poses;
    for (const std::size_t view : left) {
      poses.push_back(views.scans()[view].world_from_sensor);
    }
    const std::vector<ViewEvaluation> seen =
        evaluate_views(looking->caster(), poses, looking->rays(),
                       cells_that_count(views, map.frame(), looking->rays().max_range_m()), threads);
    const auto best = std::max_element(seen.begin(), seen.end(),
                                       [](const auto& a, const auto& b) { return a.unknown < b.unknown; });
    return left[static_cast<std::size_t>(best - seen.begin())];
  };
}

ChooseView most_expected_cells(const RecordedViews& views, const RangeSensor& sensor) {
  const auto expected = std::make_shared<ExpectedGains>(views, sensor);
  return [expected](const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left) {
    return best_of(left, expected->of(map, last, left, {}), [](const ExpectedGain& gain) { return gain.cells; });
  };
}

SoughtCells sought_next(const RecordedViews& views, ExplorationPlanner& planner) {
  return [&views, &planner](const OccupancyMap& map, std::size_t last) {
    return planner.plan(map, views.scans()[last].world_from_sensor).sought;
  };
}

SoughtCells sought_behind_frontiers() {
  return [](const OccupancyMap& map, std::size_t) {
    std::vector<VoxelIndex> cells;
    for (const VoxelIndex& frontier : frontier_cells(map)) {
      for (const VoxelIndex& step : kFaceNeighbours) {
        const VoxelIndex beside = frontier + step;
        if (map.in_region(beside) && map.at(beside) == Occupancy::Unknown) {
          cells.push_back(beside);
        }
      }
    }
    return cells;
  };
}

SoughtCells sought_in_voids() {
  return [](const OccupancyMap& map, std::size_t) { return void_cells(map); };
}

ChooseView most_for_what_is_sought(const RecordedViews& views, const RangeSensor& sensor, SoughtCells sought) {
  const auto expected = std::make_shared<ExpectedGains>(views, sensor);
  return [sought = std::move(sought), expected](const OccupancyMap& map, std::size_t last,
                                                std::span<const std::size_t> left) {
    const std::vector<ExpectedGain> gains = expected->of(map, last, left, sought(map, last));
    const auto most = std::max_element(gains.begin(), gains.end(),
                                       [](const auto& a, const auto& b) { return a.marked < b.marked; });
    const double enough = most->marked < 1.0 ? 0.0 : kEnough * most->marked;
    return best_of(left, gains, [&](const ExpectedGain& gain) { return gain.marked < enough ? -1.0 : gain.cells; });
  };
}

ChooseView nearest_to_goal(const RecordedViews& views, ExplorationPlanner& planner, double metres_per_radian,
                           GoalObserver observer) {
  const auto taken = std::make_shared<std::vector<std::size_t>>();
  return [&views, &planner, metres_per_radian, observer = std::move(observer), taken](
             const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left) {
    taken->push_back(last);
    const auto pose = [&](std::size_t view) -> const Pose& { return views.scans()[view].world_from_sensor; };
    const Plan plan = planner.plan(map, pose(last));
    const auto worth = [&](std::size_t view) {
      if (plan.outcome == Outcome::Move) {
        return -gap_m(pose(view), plan.goal.pose, metres_per_radian);
      }
      double nearest = std::numeric_limits<double>::infinity();
      for (const std::size_t other : *taken) {
        nearest = std::min(nearest, gap_m(pose(view), pose(other), metres_per_radian));
      }
      return nearest;
    };
    const std::size_t chosen = *std::max_element(left.begin(), left.end(),
                                                 [&](std::size_t a, std::size_t b) { return worth(a) < worth(b); });
    if (observer) {
      observer(plan, last, chosen);
    }
    return chosen;
  };
}

}  // namespace vantage
