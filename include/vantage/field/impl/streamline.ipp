// SPDX-License-Identifier: MIT
#pragma once

// Shade & Newman 2011, section IV-D.
#include <cmath>
#include <limits>
#include <vantage/field/streamline.hpp>

namespace vantage {
namespace detail {

// Central differences per cell. The value behind a closed face is the cell's own value, so there is no flow through
// it.
inline Eigen::Vector3d gradient_at(const Potential& potential, const VoxelIndex& cell, double own) {
  const auto beyond = [&](std::size_t face) { return potential.at(cell + kFaceNeighbours[face]).value_or(own); };
  return 0.5 * Eigen::Vector3d(beyond(1) - beyond(0), beyond(3) - beyond(2), beyond(5) - beyond(4));
}

class Flow {
 public:
  Flow(const Potential& potential, const VoxelFrame& frame) : potential_(potential), frame_(frame) {}

  // Unit direction of steepest descent; nullopt where the field is constant or there is no cell.
  [[nodiscard]] std::optional<Eigen::Vector3d> direction(const Eigen::Vector3d& at_m) const {
    const Eigen::Vector3d centred = at_m / frame_.size_m - Eigen::Vector3d::Constant(0.5);
    const Eigen::Vector3d base = centred.array().floor();
    const Eigen::Vector3d share = centred - base;
    const VoxelIndex corner{static_cast<std::int32_t>(base.x()), static_cast<std::int32_t>(base.y()),
                            static_cast<std::int32_t>(base.z())};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::int32_t i = 0; i < 8; ++i) {
      const VoxelIndex step{i & 1, i >> 1 & 1, i >> 2 & 1};
      const double weight = (step.x == 1 ? share.x() : 1.0 - share.x()) *
                            (step.y == 1 ? share.y() : 1.0 - share.y()) * (step.z == 1 ? share.z() : 1.0 - share.z());
      if (const auto own = potential_.at(corner + step); own && weight > 0.0) {
        sum -= weight * gradient_at(potential_, corner + step, *own);
      }
    }
    const double length = sum.norm();
    if (!(length > 0.0)) {
      return std::nullopt;
    }
    return Eigen::Vector3d(sum / length);
  }

 private:
  const Potential& potential_;
  const VoxelFrame& frame_;
};

}  // namespace detail

VANTAGE_INLINE std::optional<VoxelIndex> steepest_neighbour(const Potential& potential, const VoxelIndex& from) {
  double lowest = *potential.at(from);
  std::optional<VoxelIndex> best;
  for (const VoxelIndex& step : kFaceNeighbours) {
    if (const auto there = potential.at(from + step); there && *there < lowest) {
      lowest = *there;
      best = from + step;
    }
  }
  return best;
}

VANTAGE_INLINE std::size_t count_stuck_cells(const Potential& potential) {
  std::size_t stuck = 0;
  potential.domain().for_each_cell([&](const VoxelIndex& cell) {
    stuck += !potential.domain().is_sink(cell) && !steepest_neighbour(potential, cell) ? 1U : 0U;
  });
  return stuck;
}

VANTAGE_INLINE Descent descend(const Potential& potential, const VoxelIndex& from) {
  Descent descent;
  for (std::optional<VoxelIndex> at = from; at && !descent.reaches_sink; at = steepest_neighbour(potential, *at)) {
    descent.cells.push_back(*at);
    descent.reaches_sink = potential.domain().is_sink(*at);
  }
  return descent;
}

VANTAGE_INLINE std::optional<std::vector<Eigen::Vector3d>> streamline(const Potential& potential,
                                                                      const VoxelFrame& frame,
                                                                      const Eigen::Vector3d& from_m) {
  const detail::Flow flow(potential, frame);
  const double step_m = 0.5 * frame.size_m;
  // Limit on the number of points. A curve that is longer circles in a hollow between cell centres, which
  // interpolation can create even if no cell is a minimum.
  const std::size_t longest = 6 * potential.domain().cell_count();
  // Number of steps without a new lowest cell that are tolerated: phi need not decrease at every half step.
  constexpr std::size_t kWindow = 16;
  std::vector<Eigen::Vector3d> points{from_m};
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t since_lowest = 0; points.size() < longest && since_lowest < kWindow; ++since_lowest) {
    const VoxelIndex cell = frame.cell_of(points.back());
    const std::optional<double> here = potential.at(cell);
    if (!here) {
      return std::nullopt;
    }
    if (potential.domain().is_sink(cell)) {
      return points;
    }
    if (*here < lowest) {
      lowest = *here;
      since_lowest = 0;
    }
    // The midpoint rule; at the border of the domain the Euler step.
    const auto at_start = flow.direction(points.back());
    if (!at_start) {
      return std::nullopt;
    }
    const auto at_middle = flow.direction(points.back() + 0.5 * step_m * *at_start);
    points.push_back(points.back() + step_m * at_middle.value_or(*at_start));
  }
  return std::nullopt;
}

}  // namespace vantage
