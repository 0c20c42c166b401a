// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/planner/recorded_views.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vector>

namespace vantage {
namespace {

double gap_m(const Pose& a, const Pose& b, double metres_per_radian) {
  const double angle = Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
  return (a.translation() - b.translation()).norm() + metres_per_radian * std::abs(angle);
}

// The cells that count: those of the object, or a box that no view leaves.
VoxelBox cells_that_count(const RecordedViews& views, const VoxelFrame& frame, double range_m) {
  Box box;
  for (const Scan& scan : views.scans()) {
    box.extend(scan.world_from_sensor.translation() + Eigen::Vector3d::Constant(range_m));
    box.extend(scan.world_from_sensor.translation() - Eigen::Vector3d::Constant(range_m));
  }
  box = views.object().value_or(box);
  return {frame.cell_of(box.min), frame.cell_of(box.max) + VoxelIndex{1, 1, 1}};
}

// Follows the map that it is asked about from call to call.
struct FollowedCaster {
  const OccupancyMap* map = nullptr;
  std::optional<RayCaster> caster = std::nullopt;

  const RayCaster& on(const OccupancyMap& now) {
    if (map != &now) {
      caster.emplace(now);
      map = &now;
    }
    caster->update();
    return *caster;
  }
};

// How far returns came from: the share of those seen so far that came from beyond a distance.
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

// The chance of every cell of a box to become known, one value per cell; only what was touched is cleared again.
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
    const auto x = static_cast<std::size_t>(cell.x - box_.lo.x);
    const auto y = static_cast<std::size_t>(cell.y - box_.lo.y);
    const auto z = static_cast<std::size_t>(cell.z - box_.lo.z);
    float& value = chance_[(z * depth_ + y) * width_ + x];
    if (value == 0.0F) {
      touched_.push_back(&value);
    }
    value = std::max(value, static_cast<float>(chance));
  }
  /// The sum over all cells; afterwards every chance is 0 again.
  double take_sum() {
    double sum = 0.0;
    for (float* value : touched_) {
      sum += static_cast<double>(*value);
      *value = 0.0F;
    }
    touched_.clear();
    return sum;
  }

 private:
  VoxelBox box_;
  std::size_t width_;
  std::size_t depth_;
  std::vector<float> chance_;
  std::vector<float*> touched_;
};

double expected_cells(const OccupancyMap& map, const Pose& pose, const std::vector<Eigen::Vector3f>& directions,
                      double range_m, const RangeShares& shares, Chances& chances) {
  constexpr double kHopeless = 0.02;
  const Eigen::Vector3d from = pose.translation();
  for (const Eigen::Vector3f& direction : directions) {
    const Eigen::Vector3d to = from + range_m * (pose.linear() * direction.cast<double>());
    std::optional<double> began;  // the share of returns from beyond where the unknown began
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
  return chances.take_sum();
}

}  // namespace

ChooseView most_unknown_cells(const RecordedViews& views, const RangeSensor& sensor, std::size_t threads) {
  const auto caster = std::make_shared<FollowedCaster>();
  const auto rays = std::make_shared<const ViewRays>(sensor.rays_for(views.options().resolution_m));
  return [&views, caster, rays, threads](const OccupancyMap& map, std::size_t, std::span<const std::size_t> left) {
    std::vector<Pose> poses;
    for (const std::size_t view : left) {
      poses.push_back(views.scans()[view].world_from_sensor);
    }
    const std::vector<ViewEvaluation> seen = evaluate_views(
        caster->on(map), poses, *rays, cells_that_count(views, map.frame(), rays->max_range_m()), threads);
    const auto best = std::max_element(seen.begin(), seen.end(),
                                       [](const auto& a, const auto& b) { return a.unknown < b.unknown; });
    return left[static_cast<std::size_t>(best - seen.begin())];
  };
}

ChooseView most_expected_cells(const RecordedViews& views, const RangeSensor& sensor) {
  const double cell_m = views.options().resolution_m;
  const auto shares = std::make_shared<RangeShares>(cell_m, sensor.max_range_m);
  const auto directions = std::make_shared<const std::vector<Eigen::Vector3f>>(sensor.rays_for(cell_m).directions());
  const VoxelFrame frame{views.options().resolution_m};
  const auto chances = std::make_shared<Chances>(cells_that_count(views, frame, sensor.max_range_m));
  return [&views, shares, directions, chances, range_m = sensor.max_range_m](
             const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left) {
    shares->add(views.scans()[last]);
    double most = -1.0;
    std::size_t best = left.front();
    for (const std::size_t view : left) {
      const double cells =
          expected_cells(map, views.scans()[view].world_from_sensor, *directions, range_m, *shares, *chances);
      if (cells > most) {
        most = cells;
        best = view;
      }
    }
    return best;
  };
}

ChooseView nearest_to_goal(const RecordedViews& views, ExplorationPlanner& planner, double metres_per_radian) {
  const auto taken = std::make_shared<std::vector<std::size_t>>();
  return [&views, &planner, metres_per_radian, taken](const OccupancyMap& map, std::size_t last,
                                                      std::span<const std::size_t> left) {
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
    return *std::max_element(left.begin(), left.end(),
                             [&](std::size_t a, std::size_t b) { return worth(a) < worth(b); });
  };
}

}  // namespace vantage
