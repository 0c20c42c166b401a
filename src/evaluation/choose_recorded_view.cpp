// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vantage/evaluation/recorded_views.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/raytrace/following_caster.hpp>
#include <vector>

namespace vantage {
namespace {

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
  /// Sums over all cells; then sets every value to 0.
  double take_sum() {
    double sum = 0.0;
    for (const std::size_t position : touched_) {
      sum += static_cast<double>(std::exchange(chance_[position], 0.0F));
    }
    touched_.clear();
    return sum;
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
  std::vector<std::size_t> touched_;
};

// The expected number of cells that a view makes known.
double expected_gain(const OccupancyMap& map, const Pose& pose, const std::vector<Eigen::Vector3f>& directions,
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
  return chances.take_sum();
}

// Expected gains of views. It updates the distribution of the returns' ranges from view to view.
class ExpectedGains {
 public:
  ExpectedGains(const RecordedViews& views, const RangeSensor& sensor)
      : views_(&views),
        range_m_(sensor.max_range_m),
        shares_(views.options().resolution_m, sensor.max_range_m),
        directions_(sensor.rays_for(views.options().resolution_m).directions()),
        chances_(cells_that_count(views, VoxelFrame{views.options().resolution_m}, sensor.max_range_m)) {}

  /// Gains of the views `left`, in their order.
  std::vector<double> of(const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left) {
    shares_.add(views_->scans()[last]);
    std::vector<double> gains;
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
    const std::vector<double> gains = expected->of(map, last, left);
    return left[static_cast<std::size_t>(std::max_element(gains.begin(), gains.end()) - gains.begin())];
  };
}

}  // namespace vantage
